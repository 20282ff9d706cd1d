// An axis wired to a board: an encoder on GPIO edges or on a hardware counter, a motor on an
// H-bridge, a brake, and the lines that keep it safe. It is a Board of one axis.
//
// After any fault the next `read` cuts the power itself, so the torque is zero within one tick. If
// reads stop, the heartbeat line stops, and the board's own hardware cuts the power. The position
// is zero where the encoder stood at `start` or when an encoder fault was cleared; after either the
// device must be homed again. A configuration that `check` refuses latches kDeviceNotReady at
// `start`.
//
// read and write are real time. All calls come from one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/gpio_axis/axis_lines.h"
#include "drivers/gpio_axis/counter_encoder.h"
#include "drivers/gpio_axis/edge_encoder.h"
#include "drivers/gpio_axis/gpio_axis_config.h"
#include "drivers/gpio_axis/gpio_axis_trouble.h"
#include "drivers/gpio_axis/h_bridge.h"
#include "drivers/gpio_axis/safety_inputs.h"
#include "drivers/gpio_axis/silence_watch.h"
#include "hal/clock.h"
#include "hal/counter.h"
#include "hal/gpio_lines.h"
#include "hal/pwm_output.h"

namespace tactus::drivers {

// The position is zero where the encoder stood at `start` or at the clearing of an encoder fault:
// after either the device must be referenced anew. A configuration that `check` refuses latches
// kDeviceNotReady at `start`.
//
// Real time: read and write. Thread: one.
class GpioAxis {
 public:
  // All arguments but the configuration must outlive the axis. `lines` must not be requested by
  // anybody else; the PWM channel is open.
  GpioAxis(const GpioAxisConfig& config, hal::GpioLines& lines, hal::PwmOutput& pwm,
           const hal::Clock& clock);
  // Takes the position from a counter, already open, instead of GPIO lines.
  GpioAxis(const GpioAxisConfig& config, hal::Counter& counter, hal::GpioLines& lines,
           hal::PwmOutput& pwm, const hal::Clock& clock);

  // These are the calls of drivers::Board. `read` does not wait, since the newest position is
  // always there.
  [[nodiscard]] std::size_t axis_count() const { return 1; }
  void start();
  void read(std::span<AxisSample> samples, hal::TimeNs deadline_ns);
  void write(std::span<const AxisCommand> commands);
  void clear_faults();
  void stop();
  [[nodiscard]] Trouble trouble(std::size_t axis) const;

  // These are for the log: the error of the system call behind the first fault, and counts of
  // errors.
  [[nodiscard]] const hal::Error& error() const { return fault_.error; }
  [[nodiscard]] std::uint64_t edges_lost() const { return lines_.edges_lost(); }
  [[nodiscard]] std::uint64_t illegal_transitions() const {
    return encoder_.edges.illegal_transitions();
  }
  [[nodiscard]] std::int64_t index_error() const;

 private:
  // The parts of the board that the axis uses besides its lines.
  struct Hardware {
    // Null: the encoder is on GPIO lines.
    hal::Counter* counter;
    hal::PwmOutput* pwm;
    const hal::Clock* clock;
  };
  // The decoder of the encoder: one of the first two, by the hardware.
  struct Encoder {
    EdgeEncoder edges;
    CounterEncoder counts;
    SilenceWatch silence;
  };
  // The first fault since the last reset, and the error of the system call behind it, if any.
  struct FirstFault {
    GpioAxisTrouble trouble = GpioAxisTrouble::none;
    hal::Error error;
  };
  // The outputs as they were set last.
  struct Output {
    // The motor has power, and since when.
    bool powered = false;
    hal::TimeNs powered_since_ns = 0;
    // The outputs are known to be off.
    bool cut = false;
    bool reverse = false;
    bool heartbeat = false;
    double torque_Nm = 0.0;
    // The time of the last command.
    hal::TimeNs written_ns = 0;
  };

  GpioAxis(const GpioAxisConfig& config, hal::Counter* counter, hal::GpioLines& lines,
           hal::PwmOutput& pwm, const hal::Clock& clock);

  bool start_pwm();
  bool start_encoder();
  bool read_edges();
  void take(const hal::GpioEdgeEvent& event);
  void read_levels(hal::TimeNs now_ns);
  void read_counter();
  void take_sample(const EncoderReading& reading);
  void watch_silence(const EncoderReading& reading, hal::TimeNs now_ns);
  void note_safety();

  void power_up(hal::TimeNs now_ns);
  void cut_power();
  [[nodiscard]] double allowed_torque(const AxisCommand& command, hal::TimeNs now_ns) const;
  void apply(const BridgeOutput& output);
  void beat();
  bool set(AxisLine line, bool active);
  bool set_duty(hal::TimeNs duty_ns);

  bool did(const hal::Result<void>& outcome, GpioAxisTrouble gone, GpioAxisTrouble fails);
  void latch(GpioAxisTrouble trouble);

  GpioAxisConfig config_;
  Hardware hardware_;
  AxisLines lines_;
  Encoder encoder_;
  HBridge bridge_;
  SafetyInputs safety_;

  AxisSample sample_;
  FirstFault fault_;
  Output output_;
  bool running_ = false;
};

}  // namespace tactus::drivers
