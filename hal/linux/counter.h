// A counter of the Linux Counter subsystem. The count is read from sysfs, index pulses from the
// character device. Errors and threads are those of Counter.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "hal/counter.h"
#include "hal/linux/sysfs_file.h"
#include "hal/linux/system.h"

namespace tactus::hal {

// The counter and the count within it that open() opens.
struct CounterPlace {
  // The name of the counter's folder below `root`: "counter0".
  std::string_view counter;
  // The number of the count: 0 for the folder "count0".
  unsigned count = 0;
  std::string_view root = "/sys/bus/counter/devices";
  // The folder of the character device, which has the counter's name.
  std::string_view device_root = "/dev";
};

// A count of one counter. A reading costs one system call for each of the files `count`,
// `direction` and `error_noise` that the driver has. The driver must decode quadrature (ti-eqep,
// stm32-timer-cnt, ftm-quaddec, intel-qep, 104-quad-8...). interrupt-cnt counts in one direction
// only and is refused.
class LinuxCounter final : public Counter {
 public:
  // Opens the counter. Call once for each object; not real time. A start() before it returns
  // not_found.
  //   not_found      no such counter or count
  //   not_permitted  the right is missing; a udev rule gives it
  //   invalid_state  opened already
  //   disconnected, io
  Result<void> open(const CounterPlace& place);

 private:
  Result<std::uint64_t> DoStart(const CounterConfig& config) override;
  Result<CounterReading> DoRead() override;
  Result<std::size_t> DoReadIndex(std::span<CounterIndexEvent> events, TimeNs deadline_ns) override;

  // Sets an attribute if it exists and has another value.
  [[nodiscard]] Result<void> choose(const char* attribute, std::string_view value) const;
  // Sets the ceiling, if `wanted` is not 0, and returns the one in effect.
  [[nodiscard]] Result<std::uint64_t> set_ceiling(std::uint64_t wanted) const;
  // Switches the decoder to x4 and the counter on.
  [[nodiscard]] Result<void> configure() const;

  std::string folder_;
  std::string device_;
  std::uint8_t number_ = 0;
  SysfsFile count_;
  // Closed if the driver has no such file.
  SysfsFile direction_;
  // Closed if the driver has no such file.
  SysfsFile error_noise_;
  // The character device; open only while index pulses are watched.
  FileDescriptor events_;
};

}  // namespace tactus::hal
