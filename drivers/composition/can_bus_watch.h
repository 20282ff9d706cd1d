// Detects and latches the faults of the bus itself, which all its drives share.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/axis.h"
#include "hal/can_frame.h"
#include "hal/error.h"

namespace tactus::drivers {

// The bus counts as lost after so many sends in a row that did not find room in the queue. Either
// nobody acknowledges the frames, or the bus is overloaded.
inline constexpr std::uint32_t kFullQueuesToLoss = 3;

class CanBusWatch {
 public:
  // Takes the result of setting up filters or error classes. An error is a loss of the bus.
  void note(const hal::Result<void>& outcome);
  // Takes the result of a send: how many of the `offered` frames the queue took.
  void note_sent(const hal::Result<std::size_t>& sent, std::size_t offered);
  // Takes the error of a receive. A timeout is no fault.
  void note_received(const hal::Error& error);
  // Looks at a received item for an error report of the bus.
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
