#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/falcon_usb/falcon.h"
#include "host_tools/doctor/checks.h"
#include "host_tools/doctor/raspberry_pi.h"

namespace tactus::host {

namespace {

constexpr const char* kUsb = "/sys/bus/usb/devices/";
constexpr const char* kGpio = "/sys/bus/gpio/devices";

// The installed udev rules give the group tactus access to devices.
constexpr const char* kInstallRules =
    "sudo cmake --install build/release --prefix /usr && sudo udevadm control --reload && sudo "
    "udevadm trigger";

// Judges whether this user may use a device file. `found` describes it in words, `when_missing` is
// the remedy if it is not there.
Finding judge_access(Machine& machine, const std::string& check, const std::string& path,
                     const std::string& found, const std::string& when_missing) {
  const auto writable = machine.writable(path);
  if (!writable) {
    return {check, FindingState::mend, path + " is not there", when_missing};
  }
  if (!*writable) {
    return {check, FindingState::mend, fmt::format("{}: {} may not be used", found, path),
            kInstallRules};
  }
  return well(check, found);
}

// Returns the device files of the Falcons that are plugged in, such as "/dev/bus/usb/001/005".
// libusb opens these files, so their permissions decide.
std::vector<std::string> falcon_files(Machine& machine) {
  const std::string vendor = fmt::format("{:04x}", drivers::kFalconVendor);
  const std::string product = fmt::format("{:04x}", drivers::kFalconProduct);
  std::vector<std::string> files;
  for (const std::string& device : machine.names(kUsb)) {
    const std::string folder = kUsb + device;
    if (machine.text(folder + "/idVendor") != vendor ||
        machine.text(folder + "/idProduct") != product) {
      continue;
    }
    const auto number = [&](const char* file) {
      return std::strtoul(machine.text(folder + file).value_or("0").c_str(), nullptr, 10);
    };
    files.push_back(fmt::format("/dev/bus/usb/{:03}/{:03}", number("/busnum"), number("/devnum")));
  }
  return files;
}

struct GpioChip {
  // The chip's name in /dev, such as "gpiochip0"; it may change with the order of drivers at boot.
  std::string name;
  // The driver's name for the chip; empty if the chip may not be opened, so that it is not known.
  std::string label;
};

// Returns all GPIO chips of the machine.
std::vector<GpioChip> gpio_chips(Machine& machine) {
  std::vector<GpioChip> chips;
  for (const std::string& name : machine.names(kGpio)) {
    if (name.starts_with("gpiochip")) {
      chips.push_back({name, machine.gpio_label(name).value_or("")});
    }
  }
  return chips;
}

// Judges whether this user may open the chip.
Finding judge_chip(Machine& machine, const GpioChip& chip) {
  const std::string found =
      chip.label.empty() ? chip.name : fmt::format("{} ({})", chip.name, chip.label);
  return judge_access(machine, "GPIO " + chip.name, "/dev/" + chip.name, found, kInstallRules);
}

// A device's file names a chip by its path or its label. A label can only be read from a chip that
// may be opened, so "not found" may mean "not permitted".
Finding judge_named_chip(Machine& machine, const std::string& named) {
  if (named.contains('/')) {
    return judge_access(machine, "GPIO " + named, named, "there",
                        "gpiodetect   # lists those there are");
  }
  const std::vector<GpioChip> chips = gpio_chips(machine);
  const auto chip = std::ranges::find(chips, named, &GpioChip::label);
  if (chip != chips.end()) {
    return judge_chip(machine, *chip);
  }
  const auto closed = std::ranges::find(chips, "", &GpioChip::label);
  if (closed != chips.end()) {
    return {"GPIO " + named, FindingState::mend,
            fmt::format("not found, but /dev/{} may not be opened", closed->name), kInstallRules};
  }
  return {"GPIO " + named, FindingState::mend, "no chip has this label",
          "gpiodetect   # lists those there are"};
}

// Judges whether this user may take a PWM output, which begins with a write to `export`.
Finding judge_pwm(Machine& machine, const std::string& folder) {
  return judge_access(
      machine, "PWM", folder + "/export", folder,
      is_raspberry_pi(machine)
          ? add_firmware_line("dtoverlay=pwm-2chan") + "   # pins 18 and 19"
          : "ls /sys/class/pwm   # those there are; enable one in the board's device tree");
}

// Judges whether this user may start the kernel's counter for an encoder.
Finding judge_counter(Machine& machine, const std::string& counter) {
  const std::string folder = "/sys/bus/counter/devices/" + counter;
  return judge_access(machine, "counter " + counter, folder + "/count0/enable", folder,
                      "ls /sys/bus/counter/devices   # those there are; load the driver");
}

}  // namespace

void check_falcon(Machine& machine, const Needs& needs, Findings& findings) {
  if (!needs.falcon && !needs.anything) {
    return;
  }
  const std::vector<std::string> files = falcon_files(machine);
  for (const std::string& file : files) {
    findings.push_back(judge_access(machine, "Falcon", file, "plugged in",
                                    "sudo udevadm trigger   # or plug it in anew"));
  }
  if (files.empty() && needs.falcon) {
    findings.push_back({"Falcon", FindingState::mend, "not plugged in, or without power",
                        "lsusb -d 0403:cb48   # shows it once it is there"});
  } else if (files.empty()) {
    findings.push_back(well("Falcon", "not plugged in"));
  }
}

void check_serial_ports(Machine& machine, const Needs& needs, Findings& findings) {
  std::vector<std::string> ports = needs.serial_ports;
  if (needs.anything) {
    for (const std::string& name : machine.names("/sys/class/tty")) {
      if (name.starts_with("ttyACM")) {
        ports.push_back("/dev/" + name);
      }
    }
  }
  for (const std::string& port : ports) {
    findings.push_back(judge_access(machine, "serial port", port, port,
                                    "ls /dev/ttyACM*   # those there are; plug the board in"));
  }
}

void check_gpio(Machine& machine, const Needs& needs, Findings& findings) {
  if (needs.anything) {
    const std::vector<GpioChip> chips = gpio_chips(machine);
    for (const GpioChip& chip : chips) {
      findings.push_back(judge_chip(machine, chip));
    }
    if (chips.empty()) {
      findings.push_back(well("GPIO", "no chip"));
    }
  }
  for (const GpioNeed& need : needs.gpio) {
    findings.push_back(judge_named_chip(machine, need.chip));
    findings.push_back(judge_pwm(machine, need.pwm_folder));
    if (!need.counter.empty()) {
      findings.push_back(judge_counter(machine, need.counter));
    }
  }
}

}  // namespace tactus::host
