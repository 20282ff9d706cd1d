#include "firmware/device_file/board_firmware.h"

#include <span>

namespace tactus::firmware {

std::string_view board_firmware_file(const DeviceConfig& config) {
  std::string_view file;
  for (const ConnectionConfig& connection :
       std::span(config.connections).first(config.connection_count)) {
    drivers::visit_connection(connection.line, [&file](const auto& /*kind*/, const auto& line) {
      if constexpr (requires { line.firmware_file; }) {
        file = line.firmware_file.empty() ? file : line.firmware_file;
      }
    });
  }
  return file;
}

}  // namespace tactus::firmware
