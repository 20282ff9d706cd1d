// A terminal screen of fixed size in memory. Drawing needs no terminal, so tests compare screens as
// text.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace tactus::host {

// The smallest size that a terminal over ssh can be expected to have.
inline constexpr std::size_t kScreenRows = 24;
inline constexpr std::size_t kScreenColumns = 80;

// How a letter is shown; terminal.cpp chooses the colours.
enum class Style : std::uint8_t { plain, faint, strong, good, warning, bad, bar };

// One place of the screen.
struct Cell {
  char letter = ' ';
  Style style = Style::plain;
};

// The screen; rows and columns count from 0 at the upper left.
class Canvas {
 public:
  // Writes text from a column on and returns the column behind it. Characters other than printable
  // ASCII become '?'; what lies beyond the edge is cut.
  std::size_t put(std::size_t row, std::size_t column, std::string_view text,
                  Style style = Style::plain);
  // Gives `count` cells of a row another style, up to the edge.
  void paint(std::size_t row, std::size_t column, std::size_t count, Style style);

  // Returns a cell; row and column must be on the screen.
  [[nodiscard]] const Cell& at(std::size_t row, std::size_t column) const {
    return cells_[row][column];
  }
  // Returns the screen as text, one line a row, without blanks at the ends of lines.
  [[nodiscard]] std::string text() const;

 private:
  std::array<std::array<Cell, kScreenColumns>, kScreenRows> cells_{};
};

}  // namespace tactus::host
