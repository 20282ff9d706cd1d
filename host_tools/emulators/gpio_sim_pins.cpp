#include "host_tools/emulators/gpio_sim_pins.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "host_tools/input_error.h"

namespace tactus::host {

namespace {

namespace fs = std::filesystem;

// Throws InputError with the reason in `errno`.
[[noreturn]] void refuse(const fs::path& path) {
  throw InputError(path.string() + ": " + std::strerror(errno) +
                   " (gpio-sim needs root and `modprobe gpio-sim`)");
}

int open_attribute(const fs::path& path, int access) {
  const int descriptor = ::open(path.c_str(), access | O_CLOEXEC);
  if (descriptor < 0) {
    refuse(path);
  }
  return descriptor;
}

// Configfs and sysfs report an error with the write and not when the file is closed.
void write_attribute(const fs::path& path, std::string_view text) {
  const int descriptor = open_attribute(path, O_WRONLY);
  const ssize_t written = ::write(descriptor, text.data(), text.size());
  ::close(descriptor);
  if (written < 0) {
    refuse(path);
  }
}

// Returns the first line of a file of configfs or sysfs.
std::string read_attribute(const fs::path& path) {
  std::string line;
  std::ifstream file(path);
  if (!std::getline(file, line)) {
    refuse(path);
  }
  return line;
}

}  // namespace

GpioSimPins::GpioSimPins(const std::string& name, const std::string& label, std::size_t lines,
                         const fs::path& pwm_root)
    : config_(fs::path("/sys/kernel/config/gpio-sim") / name), pwm_(pwm_root / "pwmchip0/pwm0") {
  lay_out_pwm();
  open_pwm();
  std::error_code made;
  fs::create_directories(config_ / "bank0", made);
  if (made) {
    errno = made.value();
    refuse(config_);
  }
  write_attribute(config_ / "bank0/num_lines", std::to_string(lines));
  write_attribute(config_ / "bank0/label", label);
  pulls_.reserve(lines);
  values_.reserve(lines);
  plug_in();
}

GpioSimPins::~GpioSimPins() {
  close_lines();
  std::ofstream(config_ / "live") << "0";
  std::error_code ignored;
  fs::remove(config_ / "bank0", ignored);
  fs::remove(config_, ignored);
}

void GpioSimPins::lay_out_pwm() const {
  fs::create_directories(pwm_);
  std::ofstream(pwm_.parent_path() / "export") << "\n";
  for (const char* name : {"period", "duty_cycle", "enable"}) {
    std::ofstream(pwm_ / name) << "0\n";
  }
}

// The files are read many times a millisecond, so they stay open.
void GpioSimPins::open_pwm() {
  const std::array<std::pair<const char*, hal::SysfsFile*>, 3> files{
      {{"enable", &pwm_enable_}, {"period", &pwm_period_}, {"duty_cycle", &pwm_duty_}}};
  for (const auto& [name, file] : files) {
    const fs::path path = pwm_ / name;
    if (const auto opened = file->open(path.string(), hal::SysfsFile::Use::read); !opened) {
      errno = opened.error().errno_value;
      refuse(path);
    }
  }
}

void GpioSimPins::plug_in() {
  write_attribute(config_ / "live", "1");
  open_lines();
}

void GpioSimPins::unplug() {
  close_lines();
  write_attribute(config_ / "live", "0");
}

fs::path GpioSimPins::device() const {
  return fs::path("/dev") / read_attribute(config_ / "bank0/chip_name");
}

void GpioSimPins::open_lines() {
  const fs::path chip = fs::path("/sys/devices/platform") / read_attribute(config_ / "dev_name") /
                        read_attribute(config_ / "bank0/chip_name");
  const std::size_t count = std::stoul(read_attribute(config_ / "bank0/num_lines"));
  for (std::size_t i = 0; i < count; ++i) {
    const fs::path line = chip / ("sim_gpio" + std::to_string(i));
    pulls_.push_back(open_attribute(line / "pull", O_WRONLY));
    values_.push_back(open_attribute(line / "value", O_RDONLY));
  }
}

void GpioSimPins::close_lines() {
  for (const int descriptor : pulls_) {
    ::close(descriptor);
  }
  for (const int descriptor : values_) {
    ::close(descriptor);
  }
  pulls_.clear();
  values_.clear();
}

// A chip that is gone has no lines; driving one then does nothing.
void GpioSimPins::drive(std::uint32_t offset, bool high) {
  const std::string_view pull = high ? "pull-up" : "pull-down";
  if (offset < pulls_.size() && ::pwrite(pulls_[offset], pull.data(), pull.size(), 0) < 0) {
    refuse(config_);
  }
}

bool GpioSimPins::level(std::uint32_t offset) {
  char value = '0';
  if (offset < values_.size() && ::pread(values_[offset], &value, 1, 0) < 0) {
    refuse(config_);
  }
  return value == '1';
}

// The mean level from 0 to 1: duty over period, 0 while the output is off.
double GpioSimPins::pwm_level() {
  const auto number = [](const hal::SysfsFile& file) {
    return static_cast<double>(file.read_number().value_or(0));
  };
  const double period_ns = number(pwm_period_);
  if (number(pwm_enable_) != 1.0 || !(period_ns > 0.0)) {
    return 0.0;
  }
  return number(pwm_duty_) / period_ns;
}

}  // namespace tactus::host
