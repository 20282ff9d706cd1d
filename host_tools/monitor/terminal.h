// The terminal in which the monitor runs, through ncurses.
#pragma once

#include "host_tools/monitor/canvas.h"

namespace tactus::host {

// Owns the terminal as long as it lives; there can be one at a time.
class Terminal {
 public:
  // Takes the terminal over. Throws InputError if standard input or output is no terminal, or the
  // terminal's kind is unknown.
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  // Gives the terminal back as it was.
  ~Terminal();

  // Shows the screen.
  void show(const Canvas& canvas);
  // Returns the next key that was pressed, 0 if none was. It never waits.
  int key();
};

}  // namespace tactus::host
