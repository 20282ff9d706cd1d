#include "host_tools/cli/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace tactus::host {
namespace {

constexpr std::chrono::milliseconds kQuietAtFirst{2000};
constexpr std::chrono::milliseconds kInterval{500};

// Returns ", 12 s left", by the share that is done after so many seconds; nothing if that is 0.
std::string time_left(double elapsed_s, double done) {
  return done > 0.0 ? fmt::format(", {:.0f} s left", elapsed_s * (1.0 - done) / done) : "";
}

}  // namespace

ProgressLine::ProgressLine() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

ProgressLine::~ProgressLine() {
  thread_.request_stop();
  thread_.join();
}

void ProgressLine::step(std::string_view what, double done) {
  const std::scoped_lock lock(mutex_);
  what_ = what;
  done_ = done;
}

void ProgressLine::run(const std::stop_token& stop) {
  if (::isatty(STDERR_FILENO) != 1) {
    return;
  }
  std::unique_lock lock(mutex_);
  auto next = start_ + kQuietAtFirst;
  bool shown = false;
  while (!wake_.wait_until(lock, stop, next, [&] { return stop.stop_requested(); })) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    fmt::print(stderr, "{}{:.1f} s  {}{}", kWipeLine, elapsed.count(), what_,
               time_left(elapsed.count(), done_));
    std::fflush(stderr);
    shown = true;
    next += kInterval;
  }
  if (shown) {
    fmt::print(stderr, "{}", kWipeLine);
  }
}

}  // namespace tactus::host
