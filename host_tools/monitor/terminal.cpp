#include "host_tools/monitor/terminal.h"

#include <ncurses.h>
#include <unistd.h>

#include <cstdio>

#include "host_tools/input_error.h"

namespace tactus::host {

namespace {

constexpr short kGood = 1;
constexpr short kWarning = 2;
constexpr short kBad = 3;
constexpr short kBar = 4;

attr_t attributes_of(Style style) {
  switch (style) {
    case Style::plain:
      return A_NORMAL;
    case Style::faint:
      return A_DIM;
    case Style::strong:
      return A_BOLD;
    case Style::good:
      return A_BOLD | static_cast<attr_t>(COLOR_PAIR(kGood));
    case Style::warning:
      return static_cast<attr_t>(COLOR_PAIR(kWarning));
    case Style::bad:
      return A_BOLD | static_cast<attr_t>(COLOR_PAIR(kBad));
    case Style::bar:
      return static_cast<attr_t>(COLOR_PAIR(kBar));
  }
  return A_NORMAL;
}

}  // namespace

Terminal::Terminal() {
  if (::isatty(STDIN_FILENO) != 1 || ::isatty(STDOUT_FILENO) != 1) {
    throw InputError("this is no terminal; tactus watch prints lines");
  }
  if (::newterm(nullptr, stdout, stdin) == nullptr) {
    throw InputError("the terminal $TERM is not known here; try TERM=xterm tactus monitor");
  }
  ::cbreak();
  ::noecho();
  ::curs_set(0);
  ::nodelay(stdscr, true);
  ::start_color();
  ::use_default_colors();
  ::init_pair(kGood, COLOR_GREEN, -1);
  ::init_pair(kWarning, COLOR_YELLOW, -1);
  ::init_pair(kBad, COLOR_RED, -1);
  ::init_pair(kBar, COLOR_CYAN, -1);
}

Terminal::~Terminal() {
  ::endwin();
}

void Terminal::show(const Canvas& canvas) {
  ::erase();
  for (std::size_t row = 0; row < kScreenRows; ++row) {
    for (std::size_t column = 0; column < kScreenColumns; ++column) {
      const Cell& cell = canvas.at(row, column);
      if (cell.letter != ' ') {
        ::mvaddch(static_cast<int>(row), static_cast<int>(column),
                  static_cast<unsigned char>(cell.letter) | attributes_of(cell.style));
      }
    }
  }
  ::refresh();
}

int Terminal::key() {
  const int pressed = ::getch();
  return pressed == ERR ? 0 : pressed;
}

}  // namespace tactus::host
