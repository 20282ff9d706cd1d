#include "firmware/bare_metal/session.h"

#include <bit>

#include "rendering/scene/image_format.h"
#include "rendering/touch_names.h"

namespace tactus::firmware {

bool is_line_due(const TelemetryRecord& record) {
  return (record.tick + 1) % kTicksPerLine == 0;
}

Line tick_line(const TelemetryRecord& record) {
  Line line;
  line.add("tick").add(record.tick + 1).add(" hash").add_hex(record.state_hash);
  line.add(" mode ").add(mode_name(record.mode));
  line.add(" touch ").add(rendering::kContactNames[static_cast<std::size_t>(record.contact)]);
  line.add(" flagged").add(std::uint64_t{record.counters.touch_flagged});
  return line;
}

Line fault_line(const TelemetryRecord& record, std::uint64_t new_faults) {
  const auto first = static_cast<FaultBits>(1ULL << std::countr_zero(new_faults));
  Line line;
  line.add("fault").add(static_cast<std::uint64_t>(fault_code(first)));
  line.add(" ").add(fault_name(first)).add(" tick").add(record.tick + 1);
  if (record.fault_joint != 0) {
    line.add(" joint").add(std::uint64_t{record.fault_joint});
  }
  return line;
}

Line image_line(std::span<const std::byte> device, std::span<const std::byte> scene) {
  Line line;
  line.add("device").add_hex(rendering::header_checksum(device));
  line.add(", scene").add_hex(rendering::header_checksum(scene));
  return line;
}

}  // namespace tactus::firmware
