// A recorded machine in a temporary folder: a board on which everything is well, to be spoilt.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/doctor/doctor.h"

namespace tactus::host {

class RecordedMachine {
 public:
  // A Raspberry Pi with Debian's PREEMPT_RT kernel, can0 at 1 Mbit/s, a Falcon on USB and a GPIO
  // chip, and a user who is in the group.
  RecordedMachine();
  RecordedMachine(const RecordedMachine&) = delete;
  RecordedMachine& operator=(const RecordedMachine&) = delete;
  ~RecordedMachine();

  void write(std::string_view path, std::string_view text) const;
  void remove(std::string_view path) const;
  // Turns `from`, which must be in the file, into `to`.
  void change(std::string_view path, std::string_view from, std::string_view to) const;

  [[nodiscard]] Findings examine(const Needs& needs = needs_of_any_device()) const;
  // The one finding of that name; a failure and an empty one if there is not exactly one.
  [[nodiscard]] Finding finding(std::string_view check,
                                const Needs& needs = needs_of_any_device()) const;

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_;
};

}  // namespace tactus::host
