// A machine as the doctor sees it: this one, or a recorded one in a folder.
//
// A recorded machine is the tree of the files that were read, by their paths (proc/version,
// sys/class/net/can0/flags), and beside them tactus/, with what no file says: tactus/access, a line
// `w PATH` for what may be written and `- PATH` for what may not, tactus/gpio_chips, a line
// `gpiochip0 LABEL` a chip, and tactus/ip_link_can0.json, what `ip -details -json link show can0`
// prints.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

class Machine {
 public:
  // This machine, every look at which is remembered.
  Machine() = default;
  // A recorded one. Throws InputError if there is no such folder, or it holds no proc/.
  explicit Machine(std::filesystem::path root);

  // The file without the white space at its end; nothing if it cannot be read.
  std::optional<std::string> text(std::string_view path);
  // Returns the names in the folder, sorted; empty if there is no such folder.
  std::vector<std::string> names(std::string_view folder);
  // Returns whether the user may write to a file or device; nothing if there is none.
  std::optional<bool> writable(std::string_view path);
  // The label that a GPIO chip's driver gives it; nothing if the chip may not be opened.
  std::optional<std::string> gpio_label(std::string_view chip);
  // Returns the JSON that `ip` prints for a network interface; nothing without `ip` or the
  // interface.
  std::optional<std::string> ip_link(std::string_view interface);

  // Writes what was looked at so far as a recorded machine. Throws InputError.
  void save(const std::filesystem::path& folder) const;

 private:
  std::optional<std::string> recorded_line(const char* file, std::string_view key,
                                           bool key_first) const;

  std::filesystem::path root_;  // empty: this machine
  std::map<std::string, std::string, std::less<>> files_;
  std::map<std::string, bool, std::less<>> writable_;
  std::map<std::string, std::string, std::less<>> gpio_labels_;
  std::vector<std::string> folders_;
};

}  // namespace tactus::host
