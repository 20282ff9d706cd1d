#include "host_tools/cli/completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace tactus::host {
namespace {

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

// Returns the values that CLI11's own checks admit. They stand in the name of the option's type:
// TEXT:{on,off}.
std::vector<std::string> checked_values(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) {
    return {};
  }
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

std::vector<std::string> values_of(const CLI::Option& option) {
  std::vector<std::string> values = checked_values(option);
  return values.empty() ? listed_values(option.get_description()) : values;
}

// Returns the names of options, or of the verbs, that --help shows.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) {
      continue;
    }
    std::ranges::transform(option->get_lnames(), std::back_inserter(names),
                           [](const std::string& name) { return "--" + name; });
    std::ranges::transform(option->get_snames(), std::back_inserter(names),
                           [](const std::string& name) { return "-" + name; });
  }
  return names;
}

std::vector<std::string> verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(verb->get_name());
  }
  return names;
}

// Reads the words before the last one.
class CommandLine {
 public:
  explicit CommandLine(const CLI::App& app) : app_(&app) {}

  void read(const std::string& word) {
    // A shell may cut --model=dahl into three words.
    if (word == "=") {
      return;
    }
    if (option_ != nullptr) {
      option_ = nullptr;
    } else if (word.starts_with('-')) {
      const CLI::Option* option = app_->get_option_no_throw(word);
      option_ = option != nullptr && takes_value(*option) ? option : nullptr;
    } else if (const CLI::App* verb = verb_named(word); verb != nullptr) {
      app_ = verb;
    } else {
      ++positionals_;
    }
  }

  // Returns what may follow, whatever the last word begins with.
  [[nodiscard]] std::vector<std::string> candidates(bool wants_option) const {
    if (option_ != nullptr) {
      return values_of(*option_);
    }
    if (wants_option) {
      return option_names(*app_);
    }
    if (std::vector<std::string> verbs = verb_names(*app_); !verbs.empty()) {
      return positionals_ == 0 ? verbs : std::vector<std::string>{};
    }
    std::size_t place = 0;
    for (const CLI::Option* option : app_->get_options()) {
      if (option->get_positional() && place++ == positionals_) {
        return values_of(*option);
      }
    }
    return {};
  }

 private:
  [[nodiscard]] const CLI::App* verb_named(const std::string& word) const {
    const auto verbs = app_->get_subcommands([](const CLI::App*) { return true; });
    const auto found = std::ranges::find(verbs, word, &CLI::App::get_name);
    return found == verbs.end() ? nullptr : *found;
  }

  const CLI::App* app_;
  const CLI::Option* option_ = nullptr;
  std::size_t positionals_ = 0;
};

}  // namespace

std::vector<std::string> completions(const CLI::App& app, std::span<const std::string> words) {
  if (words.empty()) {
    return verb_names(app);
  }
  CommandLine line(app);
  for (const std::string& word : words.first(words.size() - 1)) {
    line.read(word);
  }
  const std::string& last = words.back() == "=" ? std::string{} : words.back();
  const std::size_t comma = last.rfind(',');
  const std::string finished = comma == std::string::npos ? "" : last.substr(0, comma + 1);
  std::vector<std::string> matching;
  for (const std::string& candidate : line.candidates(last.starts_with('-'))) {
    if ((finished + candidate).starts_with(last)) {
      matching.push_back(finished + candidate);
    }
  }
  return matching;
}

}  // namespace tactus::host
