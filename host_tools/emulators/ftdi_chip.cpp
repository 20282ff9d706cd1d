#include "host_tools/emulators/ftdi_chip.h"

#include <algorithm>
#include <array>

namespace tactus::host {

namespace {

// The status bytes of a chip without errors; the driver ignores their values.
constexpr std::array<std::byte, FtdiChip::kStatusBytes> kChipStatus = {std::byte{0x31},
                                                                       std::byte{0x60}};

}  // namespace

void FtdiChip::set_latency(std::uint16_t latency_ms) {
  latency_ms_ = static_cast<std::uint8_t>(std::max<std::uint16_t>(1, latency_ms));
}

void FtdiChip::queue(hal::TimeNs due_ns, std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    queue_.push_back({due_ns, byte});
  }
}

hal::TimeNs FtdiChip::next_packet_ns() const {
  const hal::TimeNs idle_ns = last_packet_ns_ + hal::TimeNs{latency_ms_} * 1'000'000;
  return queue_.empty() ? idle_ns : std::min(queue_.front().due_ns, idle_ns);
}

std::vector<std::byte> FtdiChip::packet(hal::TimeNs now_ns, std::size_t room) {
  if (now_ns < next_packet_ns()) {
    return {};
  }
  std::vector<std::byte> packet(kChipStatus.begin(), kChipStatus.end());
  while (!queue_.empty() && queue_.front().due_ns <= now_ns && packet.size() < room) {
    packet.push_back(queue_.front().byte);
    queue_.pop_front();
  }
  last_packet_ns_ = now_ns;
  return packet;
}

}  // namespace tactus::host
