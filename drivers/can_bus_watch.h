// Whether the bus itself still carries frames: the trouble that all its drives share, latched.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/axis.h"
#include "hal/can_frame.h"
#include "hal/error.h"

namespace tactus::drivers {

// Sends in a row that did not find room in the queue before the bus counts as lost: nobody
// acknowledges, or it is overloaded.
inline constexpr std::uint32_t kFullQueuesToLoss = 3;

class CanBusWatch {
 public:
  // How setting up filters went.
  void note(const hal::Result<void>& outcome);
  // How many of the frames were taken.
  void note_sent(const hal::Result<std::size_t>& sent, std::size_t offered);
  // Why nothing was received; a timeout is no trouble.
  void note_received(const hal::Error& error);
  // Looks for error reports.
  void take(const hal::CanReceived& received);

  [[nodiscard]] const Trouble& trouble() const { return trouble_; }
  [[nodiscard]] std::uint32_t status() const { return trouble_ ? kDeviceLost : kDeviceOk; }
  [[nodiscard]] bool is_off_the_bus() const { return off_the_bus_; }

 private:
  void lose(const hal::Error& error);

  Trouble trouble_;
  std::uint32_t full_in_a_row_ = 0;
  bool off_the_bus_ = false;
};

}  // namespace tactus::drivers
