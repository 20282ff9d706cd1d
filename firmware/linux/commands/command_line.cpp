#include "firmware/linux/commands/command_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "firmware/control/parameter_choices.h"

namespace tactus::firmware {
namespace {

using Parsed = std::expected<CommandLine, std::string_view>;

// Returns true for a character between words. A carriage return is one, for lines that end in CR
// LF.
bool is_gap(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_gap(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_gap(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

// Removes the first word from `rest` and returns it; returns an empty word at the end.
std::string_view take_word(std::string_view& rest) {
  rest = trimmed(rest);
  const auto* const end = std::ranges::find_if(rest, is_gap);
  const std::string_view word = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
  rest = trimmed(rest.substr(word.size()));
  return word;
}

template <class Number>
std::optional<Number> number_of(std::string_view word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stopped, error] = std::from_chars(word.data(), end, number);
  if (word.empty() || error != std::errc{} || stopped != end) {
    return std::nullopt;
  }
  return number;
}

Parsed parse_get(std::string_view rest) {
  const auto name = parse_parameter_name(take_word(rest));
  if (!name || !rest.empty()) {
    return std::unexpected("write get NAME; list says the names");
  }
  return CommandLine{.verb = Verb::get, .name = *name};
}

Parsed parse_set(std::string_view rest) {
  const auto name = parse_parameter_name(take_word(rest));
  const std::string_view word = take_word(rest);
  if (!name) {
    return std::unexpected("there is no such parameter; list says the names");
  }
  if (has_choices(name->parameter)) {
    if (word.empty() || !rest.empty()) {
      return std::unexpected("write set NAME VALUE, with one of the names that get NAME shows");
    }
    // The tick refuses a name that is not there, with those that the object allows.
    return CommandLine{.verb = Verb::set, .name = *name, .value = choice_of(name->parameter, word)};
  }
  const auto value = number_of<double>(word);
  if (!value || !rest.empty()) {
    return std::unexpected("write set NAME VALUE, with a number like 0.5 or 2e3");
  }
  return CommandLine{.verb = Verb::set, .name = *name, .value = *value};
}

// The rest of the line is the file, so that its name may have spaces.
Parsed parse_scene(std::string_view rest) {
  if (rest.empty()) {
    return std::unexpected("write scene FILE, an image that tactus bake has made");
  }
  return CommandLine{.verb = Verb::scene, .file = rest};
}

Parsed parse_record(std::string_view rest) {
  const std::string_view to = take_word(rest);
  if (to == "off" && rest.empty()) {
    return CommandLine{.verb = Verb::record};
  }
  if (to != "on" || rest.empty()) {
    return std::unexpected("write record on FILE, or record off");
  }
  return CommandLine{.verb = Verb::record, .file = rest};
}

Parsed parse_inject(std::string_view rest) {
  const std::string_view name = take_word(rest);
  const auto* const text = std::ranges::find(kInjectionTexts, name, &InjectionText::name);
  if (text == kInjectionTexts.end()) {
    return std::unexpected(
        "write inject FAULT [TICKS]; faults are drop, stuck, jump, nan, encoder, drive, "
        "estop_line, lost, not_ready, delay");
  }
  CommandLine line{.verb = Verb::inject, .injection = {.injection = text->injection}};
  if (rest.empty()) {
    return line;
  }
  const bool is_delay = text->injection == Injection::delay;
  const std::uint32_t most = is_delay ? kMaxInjectedDelay : kMaxInjectedTicks;
  const auto ticks = number_of<std::uint32_t>(take_word(rest));
  if (!ticks || *ticks == 0 || *ticks > most || !rest.empty()) {
    return std::unexpected(is_delay ? "a delay is 1 to 100 periods"
                                    : "an injection is 1 to 100000 ticks long");
  }
  line.injection.ticks = *ticks;
  return line;
}

Parsed parse_list(std::string_view rest) {
  return rest.empty() ? Parsed(CommandLine{.verb = Verb::list})
                      : std::unexpected("list takes no words");
}

Parsed parse_status(std::string_view rest) {
  return rest.empty() ? Parsed(CommandLine{.verb = Verb::status})
                      : std::unexpected("status takes no words");
}

Parsed parse_help(std::string_view /*rest*/) {
  return CommandLine{.verb = Verb::help};
}

// A word and the function that parses the rest of its line.
struct VerbRow {
  std::string_view word;
  Parsed (*parse)(std::string_view rest);
};

// The words that are no requests. Requests have the names of kRequestNames.
constexpr auto kVerbRows = std::to_array<VerbRow>({
    {"set", parse_set},
    {"get", parse_get},
    {"list", parse_list},
    {"status", parse_status},
    {"scene", parse_scene},
    {"record", parse_record},
    {"inject", parse_inject},
    {"help", parse_help},
});

}  // namespace

std::string_view first_word(std::string_view line) {
  return take_word(line);
}

Parsed parse_command(std::string_view line) {
  std::string_view rest = line;
  const std::string_view word = take_word(rest);
  const auto* const request = std::ranges::find(kRequestNames, word);
  if (request != kRequestNames.end() && request != kRequestNames.begin()) {
    if (!rest.empty()) {
      return std::unexpected("it takes no words");
    }
    return CommandLine{.verb = Verb::request,
                       .request = static_cast<Request>(request - kRequestNames.begin())};
  }
  const auto* const row = std::ranges::find(kVerbRows, word, &VerbRow::word);
  if (row == kVerbRows.end()) {
    return std::unexpected("there is no such command; send help");
  }
  return row->parse(rest);
}

}  // namespace tactus::firmware
