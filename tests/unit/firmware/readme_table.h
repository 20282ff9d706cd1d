// Reads the tables of firmware/README.md, which the tests hold against the code.
#pragma once

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/paths.h"

namespace tactus::firmware {

using TableRow = std::vector<std::string>;

inline std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" `");
  if (first == std::string_view::npos) {
    return {};
  }
  return std::string(text.substr(first, text.find_last_not_of(" `") - first + 1));
}

inline TableRow cells_of(std::string_view line) {
  TableRow cells;
  line.remove_prefix(1);
  for (auto bar = line.find('|'); bar != std::string_view::npos; bar = line.find('|')) {
    cells.push_back(trimmed(line.substr(0, bar)));
    line.remove_prefix(bar + 1);
  }
  return cells;
}

// The rows below the header whose first cell is `first_header`, without code marks; empty if there
// is no such table. The header itself is row 0.
inline std::vector<TableRow> readme_table(std::string_view first_header) {
  std::ifstream readme(tactus::testing::in_repository("firmware/README.md"));
  std::vector<TableRow> rows;
  bool inside = false;
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with('|')) {
      if (inside) {
        break;
      }
      continue;
    }
    TableRow cells = cells_of(line);
    inside = inside || cells.front() == first_header;
    if (inside && !cells.front().starts_with("---")) {
      rows.push_back(std::move(cells));
    }
  }
  return rows;
}

}  // namespace tactus::firmware
