#include "host_tools/doctor/live_machine.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/ethtool.h>
#include <linux/gpio.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <memory>

#include "hal/linux/system.h"

namespace tactus::host {

namespace {

// Returns true if a name is safe in a shell command. The kernel permits characters in the names of
// interfaces that mean something to a shell, and popen() goes through one.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.front() != '-' && std::ranges::all_of(name, [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' ||
           letter == '-' || letter == '.';
  });
}

}  // namespace

std::optional<bool> live_writable(std::string_view path) {
  const std::string name(path);
  return ::access(name.c_str(), F_OK) == 0 ? std::optional(::access(name.c_str(), W_OK) == 0)
                                           : std::nullopt;
}

std::optional<std::string> live_gpio_label(std::string_view chip) {
  const std::string path = fmt::format("/dev/{}", chip);
  const hal::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  gpiochip_info info{};
  if (!file.is_open() || ::ioctl(file.get(), GPIO_GET_CHIPINFO_IOCTL, &info) != 0) {
    return std::nullopt;
  }
  const auto end = std::ranges::find(info.label, '\0');
  return std::string(std::begin(info.label), end);
}

std::optional<std::string> live_ip_link(std::string_view interface) {
  if (!is_plain_name(interface)) {
    return std::nullopt;
  }
  // sbin is not in every user's path.
  const std::string command = fmt::format(
      "PATH=\"$PATH:/usr/sbin:/sbin\" ip -details -json link show {} 2>/dev/null", interface);
  const auto close = [](std::FILE* pipe) { ::pclose(pipe); };
  const std::unique_ptr<std::FILE, decltype(close)> pipe(::popen(command.c_str(), "r"), close);
  std::string text;
  std::array<char, 4096> buffer{};
  while (pipe) {
    const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe.get());
    if (got == 0) {
      break;
    }
    text.append(buffer.data(), got);
  }
  return text.empty() ? std::nullopt : std::optional(text);
}

// Any socket serves to ask the kernel about an interface.
std::optional<InterruptDelay> live_interrupt_delay(std::string_view interface) {
  const hal::FileDescriptor any(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq request{};
  if (!any.is_open() || interface.size() >= sizeof request.ifr_name) {
    return std::nullopt;
  }
  std::ranges::copy(interface, std::begin(request.ifr_name));
  ethtool_coalesce delays{};
  delays.cmd = ETHTOOL_GCOALESCE;
  request.ifr_data = reinterpret_cast<char*>(&delays);
  if (::ioctl(any.get(), SIOCETHTOOL, &request) != 0) {
    return std::nullopt;
  }
  return InterruptDelay{.microseconds = delays.rx_coalesce_usecs_irq,
                        .frames = delays.rx_max_coalesced_frames_irq};
}

}  // namespace tactus::host
