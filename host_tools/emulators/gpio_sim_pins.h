// The outside of a chip of the kernel's gpio-sim, and of a PWM channel that is a folder of files.
// `tactus emulate paddle` uses it; it needs root and the module gpio-sim.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/linux/sysfs_file.h"
#include "host_tools/emulators/board_pins.h"

namespace tactus::host {

// Makes the chip through configfs, and removes it at the end.
//
// No module of the kernel simulates a PWM chip. `pwm_root` is therefore a folder laid out like
// /sys/class/pwm with one chip "pwmchip0" of one channel 0, which hal::LinuxPwmOutput opens as if
// it were real. It consists of ordinary files: values are read back as written, nothing is refused,
// there is no waveform, and a write costs what a file costs.
class GpioSimPins final : public BoardPins {
 public:
  // `name` is the chip's folder in configfs and must be free; `label` is what the driver finds it
  // by; `lines` is from 1 to 64. Throws InputError.
  GpioSimPins(const std::string& name, const std::string& label, std::size_t lines,
              const std::filesystem::path& pwm_root);
  GpioSimPins(const GpioSimPins&) = delete;
  GpioSimPins& operator=(const GpioSimPins&) = delete;
  ~GpioSimPins() override;

  // Returns the chip's device, such as "/dev/gpiochip3". The number changes with every plug_in().
  [[nodiscard]] std::filesystem::path device() const;

  void drive(std::uint32_t offset, bool high) override;
  bool level(std::uint32_t offset) override;
  double pwm_level() override;
  void unplug() override;
  // Brings the chip back after unplug(), with its pins pulled low.
  void plug_in();

 private:
  // Makes the files of the PWM channel.
  void lay_out_pwm() const;
  // Opens them for reading.
  void open_pwm();
  // Opens the chip's lines; their place in sysfs changes with every plug_in().
  void open_lines();
  // Closes them; drive() and level() then do nothing.
  void close_lines();

  // The chip's folder in configfs.
  std::filesystem::path config_;
  // The PWM channel's folder.
  std::filesystem::path pwm_;
  hal::SysfsFile pwm_enable_;
  hal::SysfsFile pwm_period_;
  hal::SysfsFile pwm_duty_;
  // File descriptors, one for each line: its pull, which drives it, and its value.
  std::vector<int> pulls_;
  std::vector<int> values_;
};

}  // namespace tactus::host
