#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_tools/cli/completion.h"

namespace tactus::host {
namespace {

bool belongs_to_value(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
}

// Takes one value, and a remark in brackets after it, off the front of the text. Returns it without
// the full stop of a sentence; empty if the text begins otherwise.
std::string take_value(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && belongs_to_value(text[end])) {
    ++end;
  }
  if (end == 0 || std::isalnum(static_cast<unsigned char>(text.front())) == 0) {
    return {};
  }
  const std::size_t length = text[end - 1] == '.' ? end - 1 : end;
  std::string value(text.substr(0, length));
  text.remove_prefix(length);
  if (text.starts_with(" (") && text.find(')') != std::string_view::npos) {
    text.remove_prefix(text.find(')') + 1);
  }
  return value;
}

bool take(std::string_view& text, std::string_view expected) {
  if (!text.starts_with(expected)) {
    return false;
  }
  text.remove_prefix(expected.size());
  return true;
}

// Returns the values of the list that the text begins with. After "or" comes the last one; without
// it the list has three values or more and ends with the text, since two words with a comma are a
// sentence as well.
std::vector<std::string> list_at_front(std::string_view text) {
  std::vector<std::string> values;
  while (true) {
    std::string value = take_value(text);
    if (value.empty()) {
      return {};
    }
    values.push_back(std::move(value));
    if (take(text, " or ")) {
      values.push_back(take_value(text));
      const bool ends =
          text.empty() || text.front() == ';' || text.front() == ',' || text.front() == '.';
      return ends && !values.back().empty() ? values : std::vector<std::string>{};
    }
    if (!take(text, ", ")) {
      const bool ends = text.empty() || text.front() == ';' || text == ".";
      return ends && values.size() >= 3 ? values : std::vector<std::string>{};
    }
  }
}

}  // namespace

std::vector<std::string> listed_values(std::string_view description) {
  std::vector<std::string> values = list_at_front(description);
  if (const std::size_t colon = description.find(": ");
      values.empty() && colon != std::string_view::npos) {
    values = list_at_front(description.substr(colon + 2));
  }
  return values;
}

}  // namespace tactus::host
