// Checks that a text is well-formed XML, as far as pictures use it. It is a reader of its own, so
// that no library's leniency hides a fault.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::testing {

// Returns the first entity that is none, empty if all & begin one.
inline std::string entities_fault(std::string_view part) {
  constexpr auto kEntities = std::to_array<std::string_view>({"amp", "lt", "gt", "quot", "apos"});
  for (std::size_t i = part.find('&'); i != std::string_view::npos; i = part.find('&', i + 1)) {
    const std::size_t end = part.find(';', i);
    const std::string_view name =
        end == std::string_view::npos ? "" : part.substr(i + 1, end - i - 1);
    if (!name.starts_with('#') && std::ranges::find(kEntities, name) == kEntities.end()) {
      return "an & that begins no entity: " + std::string(part.substr(i, 20));
    }
  }
  return {};
}

// Returns the first fault of a tag's attributes, which begin after its name.
inline std::string attributes_fault(std::string_view rest) {
  constexpr std::string_view kBlanks = " \n\t";
  std::vector<std::string_view> names;
  for (std::size_t i = rest.find_first_not_of(kBlanks); i != std::string_view::npos;
       i = rest.find_first_not_of(kBlanks)) {
    rest.remove_prefix(i);
    const std::string_view name = rest.substr(0, rest.find_first_of(" \n\t="));
    const std::size_t opening = rest.find_first_of("\"'");
    const std::string_view before = rest.substr(0, opening);
    const std::size_t equals = before.find_first_not_of(kBlanks, name.size());
    if (opening == std::string_view::npos || equals == std::string_view::npos ||
        before[equals] != '=' ||
        before.find_first_not_of(kBlanks, equals + 1) != std::string_view::npos) {
      return "an attribute without a quoted value: " + std::string(name);
    }
    const std::size_t close = rest.find(rest[opening], opening + 1);
    if (close == std::string_view::npos) {
      return "an attribute without a closing quote: " + std::string(name);
    }
    if (std::ranges::find(names, name) != names.end()) {
      return "an attribute twice: " + std::string(name);
    }
    names.push_back(name);
    if (std::string fault = entities_fault(rest.substr(opening + 1, close - opening - 1));
        !fault.empty()) {
      return fault;
    }
    rest.remove_prefix(close + 1);
  }
  return {};
}

// The tags that are open while a text is read.
class OpenTags {
 public:
  // Takes the content of a tag, between < and >. Returns its fault, empty if it has none.
  std::string take(std::string_view tag) {
    if (tag.starts_with('?') || tag.starts_with('!')) {
      return {};
    }
    if (tag.starts_with('/')) {
      if (open_.empty() || open_.back() != tag.substr(1)) {
        return "closed, but not open: " + std::string(tag);
      }
      open_.pop_back();
      return {};
    }
    const bool is_empty = tag.ends_with('/');
    tag.remove_suffix(is_empty ? 1 : 0);
    const std::string_view name = tag.substr(0, tag.find_first_of(" \n\t"));
    if (open_.empty() && has_root_) {
      return "a second root: " + std::string(name);
    }
    has_root_ = true;
    if (!is_empty) {
      open_.emplace_back(name);
    }
    return attributes_fault(tag.substr(name.size()));
  }

  // Returns what is missing at the end of the text, empty if nothing is.
  [[nodiscard]] std::string end_fault() const {
    if (!open_.empty()) {
      return "not closed: " + open_.back();
    }
    return has_root_ ? "" : "no tag at all";
  }

 private:
  std::vector<std::string> open_;
  bool has_root_ = false;
};

// Returns the first fault of the text, empty if it is well-formed: tags are closed in their order,
// attributes are quoted and not repeated, & begins an entity, and there is one root.
inline std::string xml_fault(std::string_view text) {
  OpenTags tags;
  for (std::size_t begin = text.find('<'); begin != std::string_view::npos;
       begin = text.find('<')) {
    if (std::string fault = entities_fault(text.substr(0, begin)); !fault.empty()) {
      return fault;
    }
    text.remove_prefix(begin);
    const bool is_comment = text.starts_with("<!--");
    const std::size_t end = is_comment ? text.find("-->") : text.find('>');
    if (end == std::string_view::npos) {
      return "a tag without an end";
    }
    if (!is_comment) {
      if (std::string fault = tags.take(text.substr(1, end - 1)); !fault.empty()) {
        return fault;
      }
    }
    text.remove_prefix(end + (is_comment ? 3 : 1));
  }
  return tags.end_fault();
}

}  // namespace tactus::testing
