// A PWM channel of Linux, by sysfs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hal/linux/sysfs_file.h"
#include "hal/pwm_output.h"

namespace tactus::hal {

inline constexpr std::string_view kPwmRoot = "/sys/class/pwm";

// One write costs one system call, no path lookup and no allocation. A write that asks for what the
// channel already has is left out while no period is set, as the kernel refuses everything until
// then.
//
// Thread: as PwmOutput.
class LinuxPwmOutput final : public PwmOutput {
 public:
  LinuxPwmOutput() = default;
  LinuxPwmOutput(const LinuxPwmOutput&) = delete;
  LinuxPwmOutput& operator=(const LinuxPwmOutput&) = delete;
  // Leaves the channel disabled, at duty 0 and exported.
  ~LinuxPwmOutput();

  // Exports the channel if nobody has, disables it and sets its duty to 0: the last program may
  // have left it running. `chip` is the folder's name below `root`, such as "pwmchip0"; the kernel
  // may number chips otherwise after the next start, `device/of_node` below the folder tells them
  // apart. Once for each object; not real time.
  //   not_found      no such chip or channel
  //   not_permitted  no right to write: a udev rule gives it
  //   busy           a driver in the kernel holds the channel
  //   invalid_state  opened already
  //   disconnected, io
  Result<void> open(std::string_view chip, unsigned channel, std::string_view root = kPwmRoot);

 private:
  Result<void> DoSetPeriod(TimeNs period_ns) override;
  Result<void> DoSetDuty(TimeNs duty_ns) override;
  Result<void> DoSetPolarity(PwmPolarity polarity) override;
  Result<void> DoSetEnabled(bool enabled) override;

  Result<void> open_files(const std::string& channel_folder);
  [[nodiscard]] Result<void> silence() const;

  SysfsFile period_;
  SysfsFile duty_;
  SysfsFile polarity_;  // closed where the hardware has none
  SysfsFile enable_;
};

}  // namespace tactus::hal
