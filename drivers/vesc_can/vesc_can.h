// A VESC as a torque amplifier: each tick commands a motor current, torque over torque constant.
//
// The bring-up waits for status 1 (and 5, if the VESC offers a position) and for an answer that it
// has no fault. It sends zero current all the while, so that the VESC's own timeout runs from the
// host's commands. Then it sends no command, only the question for the timeout's flag, until the
// timeout has released the motor. A VESC that goes on without commands is refused. Without power
// wanted the motor is released, so the bridge is off. After a fault the motor is released in each
// tick until clear_faults, because a VESC forgets its faults after half a second and would obey
// again.
//
// Status bits:
//   kDeviceNotReady       until the bring-up is done
//   kDeviceStale          no status in time; not latched
//   kDeviceLost           no status for lost_after_s, or five questions without an answer
//   kDeviceDriveFault     a fault code, its timeout expired, or a required message is switched off
//   kDeviceTooHot         beside it, if the fault code is an over-temperature
//   kDeviceEmergencyStop  its kill switch
//   kDeviceEncoderFault   an impossible speed or position, which is not reported
//   kDeviceReferenceLost  if it offers a position: beside kDeviceLost and kDeviceEncoderFault, and
//                         with a fault code of supply, restart or sensor, also after another fault
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/common/continuity.h"
#include "drivers/common/counted_shaft.h"
#include "drivers/common/fault_latch.h"
#include "drivers/common/repeat_timer.h"
#include "drivers/vesc_can/vesc_config.h"
#include "drivers/vesc_can/vesc_protocol.h"

namespace tactus::drivers {

// Other values that the VESC sent; zero until it sends them.
struct VescReadings {
  vesc::Status4 status_4;
  double input_V = 0.0;
};

// A CanDrive.
class VescCan {
 public:
  // The configuration has passed `check`.
  explicit VescCan(const VescConfig& config);

  std::size_t filters(std::span<hal::CanFilter> filters) const;
  void start(hal::TimeNs now_ns);
  void take(const hal::CanReceived& received);
  void request(hal::TimeNs now_ns, CanOutbox& outbox);
  void command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox);
  [[nodiscard]] const AxisSample& sample() const { return sample_; }
  [[nodiscard]] Trouble trouble() const { return faults_.trouble(); }
  void clear_faults(hal::TimeNs now_ns);
  void shutdown(CanOutbox& outbox);

  [[nodiscard]] const VescConfig& config() const { return config_; }
  [[nodiscard]] const VescReadings& readings() const { return readings_; }

 private:
  enum class Phase : std::uint8_t { off, looking, proving, ready };

  // The phase, and its begin. From the begin of `proving` no command is sent.
  struct Stage {
    Phase phase = Phase::off;
    hal::TimeNs begun_ns = 0;
  };

  // The newest messages of the VESC. All but position_ns count from the begin of the bring-up.
  struct Heard {
    hal::TimeNs status_ns = 0;
    hal::TimeNs position_ns = 0;
    bool has_status = false;
    bool has_position = false;
    // The messages do not come in time.
    bool is_stale = false;
    // The last answers to the two questions.
    std::optional<std::uint8_t> fault;
    std::uint8_t flags = 0;
  };

  // The questions for fault and flags.
  struct Polls {
    RepeatTimer timer;
    // The number of questions since the last answer.
    std::uint32_t unanswered = 0;
    vesc::Query next_query = vesc::Query::fault;
  };

  void begin(hal::TimeNs now_ns);
  void enter(Phase phase);
  void latch(DeviceStatus bit, const Trouble& trouble);
  void may_have_restarted(const Trouble& trouble);
  void update_status();
  [[nodiscard]] bool has_passed_since(hal::TimeNs since_ns, double time_s) const;
  [[nodiscard]] bool is_poll_due() const;

  void take_status(const vesc::Status& status);
  void take_position(const vesc::Status5& status, hal::TimeNs received_ns);
  void take_answer(const vesc::Answer& answer);
  void look();
  void watch_proof();
  void watch_position();
  [[nodiscard]] Trouble missing() const;
  void watch();
  void poll(CanOutbox& outbox);
  [[nodiscard]] std::int32_t current_mA(double torque_Nm) const;

  VescConfig config_;
  CountedShaft shaft_;
  FaultLatch faults_;
  AxisSample sample_;
  VescReadings readings_;

  hal::TimeNs now_ns_ = 0;
  Continuity known_;
  Stage stage_;
  Heard heard_;
  Polls polls_;
};

static_assert(CanDrive<VescCan>);

}  // namespace tactus::drivers
