#include "host_tools/cli/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace tactus::host {
namespace {

constexpr std::chrono::milliseconds kQuietAtFirst{2000};
constexpr std::chrono::milliseconds kInterval{500};

}  // namespace

ProgressLine::ProgressLine() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

ProgressLine::~ProgressLine() {
  thread_.request_stop();
  thread_.join();
}

void ProgressLine::step(std::string_view what) {
  const std::scoped_lock lock(mutex_);
  what_ = what;
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
    fmt::print(stderr, "{}{:.1f} s  {}", kWipeLine, elapsed.count(), what_);
    std::fflush(stderr);
    shown = true;
    next += kInterval;
  }
  if (shown) {
    fmt::print(stderr, "{}", kWipeLine);
  }
}

}  // namespace tactus::host
