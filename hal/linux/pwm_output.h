// A PWM channel of Linux, through sysfs. Errors and threads are those of PwmOutput.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hal/linux/sysfs_file.h"
#include "hal/pwm_output.h"

namespace tactus::hal {

// The folder of the PWM chips.
inline constexpr std::string_view kPwmRoot = "/sys/class/pwm";

// A channel that stays open. One write costs one system call, without path lookup or allocation.
// While no period is set, a write that would change nothing is skipped, because the kernel refuses
// all writes then.
class LinuxPwmOutput final : public PwmOutput {
 public:
  LinuxPwmOutput() = default;
  LinuxPwmOutput(const LinuxPwmOutput&) = delete;
  LinuxPwmOutput& operator=(const LinuxPwmOutput&) = delete;
  // Disables the channel at duty 0 and leaves it exported.
  ~LinuxPwmOutput();

  // Exports the channel if necessary, disables it and sets its duty to 0, because the last program
  // may have left it running. `chip` is the folder's name below `root`, such as "pwmchip0". The
  // kernel may number chips differently after a reboot; `device/of_node` in the folder identifies
  // them. Call once for each object; not real time.
  //   not_found      no such chip or channel
  //   not_permitted  the right to write is missing; a udev rule gives it
  //   busy           a driver in the kernel holds the channel
  //   invalid_state  opened already
  //   disconnected, io
  Result<void> open(std::string_view chip, unsigned channel, std::string_view root = kPwmRoot);

 private:
  Result<void> DoSetPeriod(TimeNs period_ns) override;
  Result<void> DoSetDuty(TimeNs duty_ns) override;
  Result<void> DoSetEnabled(bool enabled) override;

  // Opens the attributes of an exported channel.
  Result<void> open_files(const std::string& channel_folder);
  // Writes a duty of 0 and disables the channel, as far as they are not so already.
  [[nodiscard]] Result<void> silence() const;

  SysfsFile period_;
  SysfsFile duty_;
  SysfsFile enable_;
};

}  // namespace tactus::hal
