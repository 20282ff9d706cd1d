// A line on the terminal that shows how long a slow step has been going on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace tactus::host {

// Clears the line of the terminal in which the cursor is.
inline constexpr const char* kWipeLine = "\r\x1b[K";

// Shows nothing in the first two seconds, nor at all where stderr is no terminal. From then on a
// thread of its own rewrites a line of stderr twice a second, until this object is destroyed, which
// clears the line.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Sets the text that is shown from now on. `done` is the share of the whole that is done, 0 to 1;
  // from it follows the time that is left, and 0 is not known. Any thread may call it.
  void step(std::string_view what, double done = 0.0);

 private:
  void run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::string what_;
  double done_ = 0.0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::jthread thread_;
};

}  // namespace tactus::host
