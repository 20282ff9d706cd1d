// The times of a tick's seven steps (rendering/contact/tick_watcher.h), which a watcher measures
// with its own clock. One thread; real time if the clock is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware/telemetry/record.h"
#include "firmware/telemetry/stopwatch.h"
#include "rendering/contact/tick_watcher.h"

namespace tactus::firmware {

// The duration of each step, ns, in the order of TickStep.
using StepTimes = std::array<std::uint32_t, rendering::kTickStepCount>;
// The names of the steps.
inline constexpr std::array<std::string_view, rendering::kTickStepCount> kTickStepNames = {
    "read", "tool", "collision", "proxy", "force", "command", "objects"};

// Measures the steps within the touches of a tick. Without a clock all are 0.
class StepTimer {
 public:
  explicit StepTimer(NowNs now_ns) : watch_(now_ns) {}

  // Begins a tick.
  void begin() { step_ns_ = {}; }
  // Adds the time since the last call to a step. TickStep::tool begins a touch and adds nothing.
  void end(rendering::TickStep step) {
    const std::uint32_t ns = watch_.lap_ns();
    if (step != rendering::TickStep::tool) {
      step_ns_[static_cast<std::size_t>(step)] += ns;
    }
  }
  // Leaves out the time since the last call, which was the watcher's own.
  void skip() { watch_.lap_ns(); }

  // Returns the steps of the tick. The controller's stages have those outside of the touch.
  [[nodiscard]] StepTimes times(const StageTimes& stage_ns) const {
    StepTimes times = step_ns_;
    const auto add = [&](rendering::TickStep step, std::uint32_t ns) {
      times[static_cast<std::size_t>(step)] += ns;
    };
    add(rendering::TickStep::read, stage_ns.read + stage_ns.check);
    add(rendering::TickStep::tool, stage_ns.kinematics);
    add(rendering::TickStep::command, stage_ns.safety + stage_ns.write);
    return times;
  }

 private:
  Stopwatch watch_;
  StepTimes step_ns_{};
};

}  // namespace tactus::firmware
