#include "tests/mutation/planted_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace tactus::mutation {
namespace {

[[noreturn]] void refuse(const std::string& list, std::size_t line, std::string_view what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", list, line, what));
}

// "from   a < b" is the word "from" and the text "a < b".
std::pair<std::string_view, std::string_view> word_and_rest(std::string_view line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::size_t rest = std::min(line.find_first_not_of(' ', end), line.size());
  return {line.substr(0, end), line.substr(rest)};
}

void add_text(std::string& text, std::string_view more) {
  if (!text.empty()) {
    text += '\n';
  }
  text += more;
}

void take_line(PlantedFault& fault, const std::string& list, std::size_t number,
               std::string_view line) {
  const auto [word, rest] = word_and_rest(line);
  if (word == "file") {
    fault.file = rest;
  } else if (word == "from") {
    add_text(fault.from, rest);
  } else if (word == "to") {
    add_text(fault.to, rest.empty() ? " " : rest);
  } else if (word == "tests") {
    const auto [program, filter] = word_and_rest(rest);
    fault.program = program;
    fault.filter = filter;
  } else {
    refuse(list, number, "a line begins with [, #, file, from, to or tests");
  }
}

void require_whole(const PlantedFault& fault, const std::string& list) {
  const std::array<const std::string*, 5> fields = {&fault.file, &fault.from, &fault.to,
                                                    &fault.program, &fault.filter};
  if (std::ranges::any_of(fields, [](const std::string* field) { return field->empty(); })) {
    refuse(list, fault.line, "a fault needs the lines file, from, to and tests PROGRAM FILTER");
  }
}

bool is_statement(std::string_view text) {
  return text.ends_with(';') || text.ends_with('}');
}

std::string switched(const PlantedFault& fault) {
  const std::string_view form = is_statement(fault.from)
                                    ? "if (::tactus::mutation::is_on({0})) {{ {1} }} else {{ {2} }}"
                                    : "(::tactus::mutation::is_on({0}) ? ({1}) : ({2}))";
  return fmt::format(fmt::runtime(form), fault.number, fault.to, fault.from);
}

}  // namespace

std::vector<PlantedFault> read_faults(const std::string& name, std::string_view text) {
  std::vector<PlantedFault> faults;
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    if (line.starts_with('[') && line.ends_with(']')) {
      PlantedFault& fault = faults.emplace_back();
      fault.number = static_cast<int>(faults.size());
      fault.name = line.substr(1, line.size() - 2);
      fault.line = number;
    } else if (faults.empty()) {
      refuse(name, number, "a fault begins with its name in brackets");
    } else {
      take_line(faults.back(), name, number, line);
    }
  }
  for (const PlantedFault& fault : faults) {
    require_whole(fault, name);
  }
  return faults;
}

std::string with_faults(const std::string& list, const std::string& source,
                        const std::vector<PlantedFault>& faults) {
  struct Place {
    std::size_t at;
    const PlantedFault* fault;
  };
  std::vector<Place> places;
  for (const PlantedFault& fault : faults) {
    const std::size_t at = source.find(fault.from);
    if (at == std::string::npos || source.find(fault.from, at + 1) != std::string::npos) {
      refuse(list, fault.line,
             fmt::format("the text of 'from' does not stand exactly once in {}; the code has "
                         "changed: write it as it is now, or a longer part of it",
                         fault.file));
    }
    places.push_back({at, &fault});
  }
  std::ranges::sort(places, {}, &Place::at);
  std::string result = "#include \"planted_switch.h\"\n#line 1\n";
  std::size_t done = 0;
  for (const Place& place : places) {
    if (place.at < done) {
      refuse(list, place.fault->line, "two faults of one file overlap; choose another place");
    }
    result += source.substr(done, place.at - done) + switched(*place.fault);
    done = place.at + place.fault->from.size();
  }
  return result + source.substr(done);
}

}  // namespace tactus::mutation
