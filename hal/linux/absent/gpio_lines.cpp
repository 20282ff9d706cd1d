// LinuxGpioLines of a build without libgpiod 2: no line can be requested.
#include "hal/linux/gpio_lines.h"

namespace tactus::hal {
namespace {

constexpr Error kNoLibgpiod{ErrorCode::not_supported, 0};

}  // namespace

bool has_libgpiod() {
  return false;
}

LinuxGpioLines::~LinuxGpioLines() = default;

Result<void> LinuxGpioLines::DoRequest(const GpioRequest& /*request*/) {
  return std::unexpected(kNoLibgpiod);
}

void LinuxGpioLines::DoRelease() {}

Result<std::uint64_t> LinuxGpioLines::DoGet(std::uint64_t /*mask*/) {
  return std::unexpected(kNoLibgpiod);
}

Result<void> LinuxGpioLines::DoSet(std::uint64_t /*mask*/, std::uint64_t /*values*/) {
  return std::unexpected(kNoLibgpiod);
}

Result<std::size_t> LinuxGpioLines::DoReadEdges(std::span<GpioEdgeEvent> /*events*/,
                                                TimeNs /*deadline_ns*/) {
  return std::unexpected(kNoLibgpiod);
}

}  // namespace tactus::hal
