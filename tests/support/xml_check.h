// Checks that a text is well-formed XML, as far as pictures use it. It is a reader of its own, so
// that no library's leniency hides a fault.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::testing {

// Returns the first fault of the text, empty if it is well-formed: tags are closed in their order,
// attributes are quoted and not repeated, & begins an entity, and there is one root.
inline std::string xml_fault(std::string_view text) {
  std::vector<std::string> open;
  bool has_root = false;
  std::size_t at = 0;
  const auto entities_fault = [](std::string_view part) -> std::string {
    for (std::size_t i = part.find('&'); i != std::string_view::npos; i = part.find('&', i + 1)) {
      const std::size_t end = part.find(';', i);
      const std::string_view name = part.substr(i + 1, end - i - 1);
      if (end == std::string_view::npos || name.empty() ||
          (name[0] != '#' && name != "amp" && name != "lt" && name != "gt" && name != "quot" &&
           name != "apos")) {
        return "an & that begins no entity: " + std::string(part.substr(i, 20));
      }
    }
    return {};
  };
  while (at < text.size()) {
    const std::size_t begin = text.find('<', at);
    const std::string_view between = text.substr(at, begin - at);
    if (std::string fault = entities_fault(between); !fault.empty()) {
      return fault;
    }
    if (begin == std::string_view::npos) {
      break;
    }
    if (text.substr(begin, 4) == "<!--") {
      at = text.find("-->", begin) + 3;
      continue;
    }
    const std::size_t end = text.find('>', begin);
    if (end == std::string_view::npos) {
      return "a tag without an end";
    }
    std::string_view tag = text.substr(begin + 1, end - begin - 1);
    at = end + 1;
    if (tag.starts_with('?') || tag.starts_with('!')) {
      continue;
    }
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1)) {
        return "closed, but not open: " + std::string(tag);
      }
      open.pop_back();
      continue;
    }
    const bool is_empty = tag.ends_with('/');
    tag = tag.substr(0, tag.size() - (is_empty ? 1 : 0));
    const std::size_t name_end = tag.find_first_of(" \n\t");
    const std::string name(tag.substr(0, name_end));
    if (open.empty() && has_root) {
      return "a second root: " + name;
    }
    has_root = true;
    std::vector<std::string_view> names;
    std::string_view rest = name_end == std::string_view::npos ? "" : tag.substr(name_end);
    for (std::size_t i = rest.find_first_not_of(" \n\t"); i != std::string_view::npos;
         i = rest.find_first_not_of(" \n\t")) {
      rest.remove_prefix(i);
      const std::size_t equals = rest.find('=');
      if (equals == std::string_view::npos || equals + 1 >= rest.size()) {
        return "an attribute without a value in " + name;
      }
      const std::string_view attribute = rest.substr(0, rest.find_first_of(" \n\t="));
      for (const std::string_view other : names) {
        if (other == attribute) {
          return "an attribute twice: " + std::string(attribute);
        }
      }
      names.push_back(attribute);
      const std::size_t opening =
          std::min(rest.find_first_not_of(" \n\t", equals + 1), rest.size() - 1);
      const char quote = rest[opening];
      const std::size_t close = rest.find(quote, opening + 1);
      if ((quote != '"' && quote != '\'') || close == std::string_view::npos) {
        return "an attribute without quotes: " + std::string(attribute);
      }
      if (std::string fault = entities_fault(rest.substr(opening + 1, close - opening - 1));
          !fault.empty()) {
        return fault;
      }
      rest.remove_prefix(close + 1);
    }
    if (!is_empty) {
      open.push_back(name);
    }
  }
  return !open.empty() ? "not closed: " + open.back() : has_root ? "" : "no tag at all";
}

}  // namespace tactus::testing
