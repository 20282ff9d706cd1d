// Reads and writes the objects of one drive by SDO: those of the bring-up in their order, and
// single ones on demand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/cia402_can/bring_up.h"
#include "drivers/cia402_can/cia402_config.h"
#include "drivers/cia402_can/sdo_client.h"
#include "hal/clock.h"

namespace tactus::drivers::cia402 {

class DriveObjects {
 public:
  // The reason why a step of the bring-up failed.
  struct Failure {
    DeviceStatus status = kDeviceDriveFault;
    Trouble trouble;
  };
  // True: it is done. False: it waits for an answer.
  using Progress = std::expected<bool, Failure>;

  explicit DriveObjects(const Cia402Config& config);

  // Drops an open question.
  void reset() { sdo_.reset(); }
  // Begins the set-up with its first step.
  void begin_set_up();
  // Forgets that torque mode was set, for a drive that is started again. Keeps the facts.
  void restart();

  // Takes a frame of the drive. Others are ignored.
  void take(const hal::CanFrame& frame) { sdo_.take(frame); }

  // These go on with the steps of bring_up.h: those before the drive is operational, and torque
  // mode after that. `config` is that of the constructor.
  Progress set_up(const Cia402Config& config, hal::TimeNs now_ns, CanOutbox& outbox);
  Progress choose_torque_mode(const Cia402Config& config, hal::TimeNs now_ns, CanOutbox& outbox);

  // Returns the value of the object once it has been read, else nothing. It asks for the object,
  // and asks again after a refusal.
  std::optional<std::uint32_t> read(canopen::ObjectAddress object, hal::TimeNs now_ns,
                                    CanOutbox& outbox);
  [[nodiscard]] bool is_asking() const { return sdo_.state() == canopen::SdoClient::State::asking; }

  // Returns true once choose_torque_mode is done.
  [[nodiscard]] bool mode_is_set() const { return mode_is_set_; }
  [[nodiscard]] const DriveFacts& facts() const { return facts_; }

 private:
  Progress run(const SdoStep& step, const Cia402Config& config, hal::TimeNs now_ns,
               CanOutbox& outbox);
  [[nodiscard]] Failure refusal(const SdoStep& step, canopen::SdoClient::State state) const;

  canopen::SdoClient sdo_;
  DriveFacts facts_;
  std::size_t step_ = 0;  // of the set-up
  bool mode_is_set_ = false;
};

}  // namespace tactus::drivers::cia402
