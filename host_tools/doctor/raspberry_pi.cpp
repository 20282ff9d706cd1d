#include "host_tools/doctor/raspberry_pi.h"

#include <fmt/format.h>

namespace tactus::host {

bool is_raspberry_pi(Machine& machine) {
  return machine.text("/proc/device-tree/model").value_or("").starts_with("Raspberry Pi");
}

std::string add_firmware_line(std::string_view line) {
  return fmt::format("echo {} | sudo tee -a /boot/firmware/config.txt && sudo reboot", line);
}

std::string add_kernel_words(std::string_view words) {
  return fmt::format("sudo sed -i '1s/$/ {}/' /boot/firmware/cmdline.txt && sudo reboot", words);
}

}  // namespace tactus::host
