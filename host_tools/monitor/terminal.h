// The terminal that the monitor runs in, by ncurses.
#pragma once

#include "host_tools/monitor/canvas.h"

namespace tactus::host {

class Terminal {
 public:
  // Takes the terminal. Throws InputError where standard output is none, or one that is not known.
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  // Gives it back as it was.
  ~Terminal();

  void show(const Canvas& canvas);
  // The next key that was pressed; 0 if none was. Never waits.
  int key();
};

}  // namespace tactus::host
