// The outside of a chip of the kernel's gpio-sim, and of a PWM channel that is a folder of files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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
  // The chip's label will be "`name`-lines". `lines` from 1 to 64.
  GpioSimPins(std::string name, std::size_t lines, std::filesystem::path pwm_root);
  ~GpioSimPins() override;

  [[nodiscard]] std::string label() const { return name_ + "-lines"; }

  void drive(std::uint32_t offset, bool high) override;
  bool level(std::uint32_t offset) override;
  double pwm_level() override;
  void unplug() override;
  // After unplug: a chip of the same label, its pins pulled low.
  void plug_in();

 private:
  void lay_out_pwm() const;
  void open_lines();
  void close_lines();

  std::string name_;
  std::filesystem::path config_;  // in configfs
  std::filesystem::path pwm_;     // the channel's folder
  std::vector<int> pulls_;        // descriptors, one for each line
  std::vector<int> values_;
};

}  // namespace tactus::host
