// A terminal screen of fixed size in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace tactus::host {

// The smallest that a terminal over ssh may be taken to have.
inline constexpr std::size_t kScreenRows = 24;
inline constexpr std::size_t kScreenColumns = 80;

enum class Style : std::uint8_t { plain, faint, strong, good, warning, bad, bar };

struct Cell {
  char letter = ' ';
  Style style = Style::plain;
};

class Canvas {
 public:
  // Printable ASCII; anything else becomes '?', what is beyond the edge is cut. Returns the column
  // behind it.
  std::size_t put(std::size_t row, std::size_t column, std::string_view text,
                  Style style = Style::plain);
  // Gives a part of a row, up to the edge at most, another style.
  void paint(std::size_t row, std::size_t column, std::size_t count, Style style);

  [[nodiscard]] const Cell& at(std::size_t row, std::size_t column) const {
    return cells_[row][column];
  }
  // A line a row, without the blanks at its end.
  [[nodiscard]] std::string text() const;

 private:
  std::array<std::array<Cell, kScreenColumns>, kScreenRows> cells_{};
};

}  // namespace tactus::host
