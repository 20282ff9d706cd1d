// The outside of a chip of the kernel's gpio-sim, and of a PWM channel that is a folder of files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/linux/sysfs_file.h"
#include "host_tools/emulators/board_pins.h"

namespace tactus::host {

// Makes the chip through configfs and takes it away again. Needs root and the module gpio-sim.
//
// The emulated machine has no PWM chip. `pwm_root` is a folder laid out like /sys/class/pwm with
// one chip "pwmchip0" of one channel 0, which hal::LinuxPwmOutput opens as if it were real. It is
// ordinary files: what is written is read back, nothing is refused, no waveform comes out, and a
// write costs what a file costs.
class GpioSimPins final : public BoardPins {
 public:
  // `name` is the folder's in configfs and must be free. `lines` from 1 to 64.
  GpioSimPins(const std::string& name, const std::string& label, std::size_t lines,
              const std::filesystem::path& pwm_root);
  GpioSimPins(const GpioSimPins&) = delete;
  GpioSimPins& operator=(const GpioSimPins&) = delete;
  ~GpioSimPins() override;

  // The chip's device: "/dev/gpiochip3". The number changes with every plug_in.
  [[nodiscard]] std::filesystem::path device() const;

  void drive(std::uint32_t offset, bool high) override;
  bool level(std::uint32_t offset) override;
  double pwm_level() override;
  void unplug() override;
  // Brings the chip back after unplug, with its pins pulled low.
  void plug_in();

 private:
  void lay_out_pwm() const;
  void open_pwm();
  void open_lines();
  void close_lines();

  std::filesystem::path config_;  // in configfs
  std::filesystem::path pwm_;     // the channel's folder
  hal::SysfsFile pwm_enable_;
  hal::SysfsFile pwm_period_;
  hal::SysfsFile pwm_duty_;
  std::vector<int> pulls_;  // descriptors, one for each line
  std::vector<int> values_;
};

}  // namespace tactus::host
