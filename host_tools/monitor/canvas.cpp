#include "host_tools/monitor/canvas.h"

#include <algorithm>

namespace tactus::host {

std::size_t Canvas::put(std::size_t row, std::size_t column, std::string_view text, Style style) {
  if (row >= kScreenRows) {
    return column;
  }
  for (const char letter : text) {
    if (column >= kScreenColumns) {
      break;
    }
    cells_[row][column] = {letter >= ' ' && letter <= '~' ? letter : '?', style};
    ++column;
  }
  return column;
}

void Canvas::paint(std::size_t row, std::size_t column, std::size_t count, Style style) {
  for (std::size_t i = column; row < kScreenRows && i < std::min(column + count, kScreenColumns);
       ++i) {
    cells_[row][i].style = style;
  }
}

std::string Canvas::text() const {
  std::string all;
  for (const auto& row : cells_) {
    std::string line;
    for (const Cell& cell : row) {
      line += cell.letter;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    all += line + '\n';
  }
  return all;
}

}  // namespace tactus::host
