// A counter of the Linux Counter subsystem. The count is read from sysfs, index pulses from the
// character device.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "hal/counter.h"
#include "hal/linux/sysfs_file.h"
#include "hal/linux/system.h"

namespace tactus::hal {

struct CounterPlace {
  std::string_view counter;  // the folder's name below `root`: "counter0"
  unsigned count = 0;        // number of the count: 0 for the folder "count0"
  std::string_view root = "/sys/bus/counter/devices";
  std::string_view device_root = "/dev";  // folder of the character device with the same name
};

// A reading costs one system call for each of the files `count`, `direction` and `error_noise` that
// the driver has. The driver must decode quadrature (ti-eqep, stm32-timer-cnt, ftm-quaddec,
// intel-qep, 104-quad-8...). interrupt-cnt counts in one direction only and is refused.
//
// Threads: see Counter.
class LinuxCounter final : public Counter {
 public:
  // Opens the counter. Call once for each object; not real time.
  //   not_found      no such counter or count
  //   not_permitted  the right is missing; a udev rule gives it
  //   invalid_state  opened already
  //   disconnected, io
  Result<void> open(const CounterPlace& place);

 private:
  Result<std::uint64_t> DoStart(const CounterConfig& config) override;
  Result<CounterReading> DoRead() override;
  Result<std::size_t> DoReadIndex(std::span<CounterIndexEvent> events, TimeNs deadline_ns) override;

  [[nodiscard]] Result<void> choose(const char* attribute, std::string_view value) const;
  [[nodiscard]] Result<std::uint64_t> set_ceiling(std::uint64_t wanted) const;
  [[nodiscard]] Result<void> configure() const;

  std::string folder_;
  std::string device_;
  std::uint8_t number_ = 0;
  SysfsFile count_;
  SysfsFile direction_;    // closed if the driver has no such file
  SysfsFile error_noise_;  // closed if the driver has no such file
  FileDescriptor events_;
};

}  // namespace tactus::hal
