#include "firmware/linux/realtime/loop_timing.h"

namespace tactus::firmware {

LoopTick LoopTiming::woke(const hal::Wake& wake) {
  const hal::TimeNs latency_ns = wake.woke_ns - wake.scheduled_ns;
  const bool late = wake.skipped > 0 || latency_ns > period_ns_ / 2;
  histogram(Timed::wake_up).add(latency_ns);
  missed_ += static_cast<std::uint64_t>(wake.skipped);
  late_ += late ? 1U : 0U;
  return {.scheduled_ns = wake.scheduled_ns,
          .woke_ns = wake.woke_ns,
          .skipped = wake.skipped,
          .late = late};
}

void LoopTiming::done(LoopTick& tick, const StageTimes& stages, hal::TimeNs now_ns) {
  tick.done_ns = now_ns;
  histogram(Timed::tick).add(now_ns - tick.woke_ns);
  histogram(Timed::read).add(stages.read);
  histogram(Timed::check).add(stages.check);
  histogram(Timed::kinematics).add(stages.kinematics);
  histogram(Timed::touch).add(stages.touch);
  histogram(Timed::safety).add(stages.safety);
  histogram(Timed::write).add(stages.write);
}

}  // namespace tactus::firmware
