#include "host_tools/cli/reach_controller.h"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <string_view>

#include "host_tools/cli/progress_line.h"
#include "host_tools/input_error.h"

namespace tactus::host {

GatewayOptions gateway_options(const std::string& place) {
  GatewayOptions options;
  options.place = parse_serial_place(place);
  const auto line = std::make_shared<std::unique_ptr<ProgressLine>>();
  options.progress = [line](std::string_view image, std::size_t bytes, std::size_t total) {
    if (*line == nullptr) {
      *line = std::make_unique<ProgressLine>();
    }
    (*line)->step(
        fmt::format("the board's {} image: {} of {} kB", image, bytes / 1000, total / 1000),
        static_cast<double>(bytes) / static_cast<double>(total));
    if (bytes == total) {
      line->reset();
    }
  };
  return options;
}

void with_controller(const RunFolderOption& option, const LineNeeds& needs,
                     const ControllerWork& work) {
  if (option.serial.empty()) {
    work(option.folder(), nullptr);
    return;
  }
  GatewayOptions options = gateway_options(option.serial);
  options.wants_ticks = needs.ticks;
  options.wants_images = needs.images;
  LineSession session(std::move(options));
  try {
    work(session.folder(), &session);
  } catch (const UnreachableError&) {
    session.finish();  // a lost line is the cause, and says more
    throw;
  } catch (const InputError&) {
    session.finish();
    throw;
  }
  session.finish();
}

}  // namespace tactus::host
