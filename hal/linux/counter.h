// A counter of Linux's Counter subsystem: the count by sysfs, index pulses by the character device.
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
  unsigned count = 0;        // which of the counter's counts: the folder "count0"
  std::string_view root = "/sys/bus/counter/devices";
  std::string_view device_root = "/dev";  // where the character device of the same name is
};

// A reading costs one system call for each of `count`, `direction` and `error_noise` that the
// driver has. Needs a driver that decodes quadrature (ti-eqep, stm32-timer-cnt, ftm-quaddec,
// intel-qep, 104-quad-8...); interrupt-cnt counts in one direction only and is refused.
//
// Thread: as Counter.
class LinuxCounter final : public Counter {
 public:
  // Once for each object; not real time.
  //   not_found      no such counter or count
  //   not_permitted  no right: a udev rule gives it
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
  SysfsFile direction_;    // closed where the driver has none
  SysfsFile error_noise_;  // the same
  FileDescriptor events_;
};

}  // namespace tactus::hal
