// The machine that the doctor examines: this one, or one that was recorded in a folder. Checks look
// only through this class, so every machine can be recorded and examined elsewhere, and the tests
// present machines that they do not have.
//
// A recorded machine is a copy of the files that were read, by their paths (proc/version,
// sys/class/net/can0/flags), beside a folder tactus/ with the facts that stand in no file:
//
// - tactus/access: a line `w PATH` for what may be written to, `- PATH` for what may not.
// - tactus/gpio_chips: a line `gpiochip0 LABEL` a chip.
// - tactus/unit_cost_ns: the time of a cost unit of the rendering, ns (rendering/tick_budget.h).
// - tactus/interrupt_delays: a line `can0 MICROSECONDS FRAMES` an interface.
// - tactus/ip_link_can0.json: the output of `ip -details -json link show can0`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// The delay of a network interface's interrupt: it comes when so many frames have come, or the time
// since the first of them is over.
struct InterruptDelay {
  std::uint32_t microseconds = 0;
  std::uint32_t frames = 0;
};

// Answers questions about a machine. One thread.
class Machine {
 public:
  // This machine. Every answer is remembered for save().
  Machine() = default;
  // A recorded machine. Throws InputError if the folder is missing or holds no proc/.
  explicit Machine(std::filesystem::path root);

  // Returns the content of a file without the white space at its end; nothing if it cannot be read.
  std::optional<std::string> text(std::string_view path);
  // Returns the names in the folder, sorted; empty if there is no such folder.
  std::vector<std::string> names(std::string_view folder);
  // Returns true if this user may write to a file or device; nothing if there is none.
  std::optional<bool> writable(std::string_view path);
  // Returns the label that a GPIO chip's driver gives it; nothing if the chip may not be opened.
  std::optional<std::string> gpio_label(std::string_view chip);
  // Returns the JSON that `ip` prints for a network interface; nothing without `ip` or the
  // interface.
  std::optional<std::string> ip_link(std::string_view interface);
  // Returns the delay of an interface's interrupts of received frames, as `ethtool -c` prints it
  // (rx-usecs-irq and rx-frames-irq); nothing if its driver has none to set.
  std::optional<InterruptDelay> interrupt_delay(std::string_view interface);
  // Returns a number of the device tree, whose file is its four bytes, the highest first; nothing
  // if there is no such file.
  std::optional<std::uint32_t> device_tree_number(std::string_view path);
  // Returns the time that a cost unit of the rendering takes (rendering/tick_budget.h), ns; nothing
  // if a recorded machine does not say it. On this machine it takes a fraction of a second.
  std::optional<double> unit_cost_ns();

  // Writes all remembered answers as a recorded machine. Throws InputError if the folder cannot be
  // written to.
  void save(const std::filesystem::path& folder) const;

 private:
  // Returns the other half of the first line "A B" of a recorded file whose half A, or B if not
  // `key_first`, is `key`.
  std::optional<std::string> recorded_line(const char* file, std::string_view key,
                                           bool key_first) const;

  // The folder of a recorded machine; empty for this machine.
  std::filesystem::path root_;
  std::map<std::string, std::string, std::less<>> files_;
  std::map<std::string, bool, std::less<>> writable_;
  std::map<std::string, std::string, std::less<>> gpio_labels_;
  std::map<std::string, InterruptDelay, std::less<>> interrupt_delays_;
  // Entries of the folders that were listed; save() makes them, so that names() lists them again.
  std::vector<std::string> folders_;
};

}  // namespace tactus::host
