// One line on the terminal that tells how long a slow step has been going on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace tactus::host {

// Takes back the terminal's line that the cursor is in.
inline constexpr const char* kWipeLine = "\r\x1b[K";

// Shows nothing in the first two seconds; then rewrites a line of stderr twice a second, from a
// thread of its own, until destroyed, which wipes the line.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Sets the text of the step that begins now. Any thread may call it.
  void step(std::string_view what);

 private:
  void run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::string what_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::jthread thread_;
};

}  // namespace tactus::host
