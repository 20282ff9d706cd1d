#include "host_tools/cli/replay_explanation.h"

#include <fmt/format.h>

#include <string_view>

#include "host_tools/explain/tick_summary.h"

namespace tactus::host {

ReplayExplanation::ReplayExplanation(const std::string& file, firmware::Controller& controller,
                                     double tool_radius_m, Recording& recording)
    : steps_(file, controller, tool_radius_m, nullptr), recording_(recording) {}

void ReplayExplanation::add(const firmware::TelemetryRecord& record) {
  while (!at_end_ && (!next_ || next_->tick < record.tick)) {
    next_ = recording_.next_explanation();
    at_end_ = !next_;
  }
  if (!next_ || next_->tick != record.tick) {
    steps_.add(record);
    return;
  }
  const firmware::Explanation here = steps_.add(record, next_->step_ns);
  const std::string_view field = first_difference(*next_, here);
  ++compared_;
  if (difference_.empty() && !field.empty()) {
    difference_ = fmt::format("tick {} ({:.3f} s): the recorded explanation differs in its {}\n",
                              record.tick, record.time_s, field);
  }
}

void ReplayExplanation::close() {
  steps_.close();
  if (!difference_.empty()) {
    fmt::print("{}", difference_);
  } else if (compared_ > 0) {
    fmt::print("{} recorded explanations: all equal\n", compared_);
  }
}

}  // namespace tactus::host
