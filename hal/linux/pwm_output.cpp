#include "hal/linux/pwm_output.h"

#include <unistd.h>

#include <cerrno>

namespace tactus::hal {

namespace {

Result<void> export_channel(const std::string& chip_folder, unsigned channel) {
  SysfsFile file;
  if (const auto opened = file.open(chip_folder + "/export", SysfsFile::Use::write); !opened) {
    return opened;
  }
  const auto exported = file.write_number(channel);
  // The kernel answers a channel's number that the chip does not have with ENODEV.
  if (!exported && exported.error().errno_value == ENODEV) {
    return failure(ErrorCode::not_found, ENODEV);
  }
  return exported;
}

Result<void> write_zero_unless_zero(const SysfsFile& file) {
  const auto number = file.read_number();
  if (!number) {
    return std::unexpected(number.error());
  }
  return *number == 0 ? Result<void>{} : file.write_number(0);
}

}  // namespace

LinuxPwmOutput::~LinuxPwmOutput() {
  if (enable_.is_open()) {
    (void)silence();
  }
}

Result<void> LinuxPwmOutput::open(std::string_view chip, unsigned channel, std::string_view root) {
  if (enable_.is_open()) {
    return failure(ErrorCode::invalid_state);
  }
  const std::string chip_folder = std::string(root) + "/" + std::string(chip);
  const std::string channel_folder = chip_folder + "/pwm" + std::to_string(channel);
  if (::access(channel_folder.c_str(), F_OK) != 0) {
    if (const auto exported = export_channel(chip_folder, channel); !exported) {
      return exported;
    }
  }
  auto opened = open_files(channel_folder);
  if (opened) {
    opened = silence();
  }
  if (!opened) {
    enable_.close();
  }
  return opened;
}

Result<void> LinuxPwmOutput::open_files(const std::string& channel_folder) {
  constexpr auto kUse = SysfsFile::Use::read_and_write;
  if (const auto opened = period_.open(channel_folder + "/period", kUse); !opened) {
    return opened;
  }
  if (const auto opened = duty_.open(channel_folder + "/duty_cycle", kUse); !opened) {
    return opened;
  }
  return enable_.open(channel_folder + "/enable", kUse);
}

Result<void> LinuxPwmOutput::silence() const {
  const auto duty = write_zero_unless_zero(duty_);
  const auto enable = write_zero_unless_zero(enable_);
  return duty ? enable : duty;
}

Result<void> LinuxPwmOutput::DoSetPeriod(TimeNs period_ns) {
  return period_.write_number(static_cast<std::uint64_t>(period_ns));
}

Result<void> LinuxPwmOutput::DoSetDuty(TimeNs duty_ns) {
  if (settings().period_ns == 0) {
    return {};
  }
  return duty_.write_number(static_cast<std::uint64_t>(duty_ns));
}

Result<void> LinuxPwmOutput::DoSetEnabled(bool enabled) {
  if (settings().period_ns == 0) {
    return {};
  }
  return enable_.write_number(enabled ? 1 : 0);
}

}  // namespace tactus::hal
