#include "hal/gpio_lines.h"

#include <algorithm>

namespace tactus::hal {

namespace {

// Edges and debouncing exist for inputs only, a drive for outputs only.
bool is_valid_line(const GpioLineConfig& line) {
  if (line.direction == GpioDirection::output) {
    return line.edges == GpioEdges::none && line.debounce_us == 0;
  }
  return line.drive == GpioDrive::push_pull;
}

bool names_an_offset_twice(std::span<const GpioLineConfig> lines) {
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto earlier = lines.first(i);
    if (std::ranges::find(earlier, lines[i].offset, &GpioLineConfig::offset) != earlier.end()) {
      return true;
    }
  }
  return false;
}

// Returns a mask of the lowest `count` bits. A shift by 64 is undefined, hence the case of all
// bits.
std::uint64_t first_bits(std::size_t count) {
  return count >= kMaxGpioLines ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

}  // namespace

Result<void> GpioLines::request(const GpioRequest& request) {
  if (count_ != 0) {
    return failure(ErrorCode::invalid_state);
  }
  const auto lines = request.lines;
  if (lines.empty() || lines.size() > kMaxGpioLines || !std::ranges::all_of(lines, is_valid_line) ||
      names_an_offset_twice(lines) || request.edge_buffer > kMaxGpioEdgeBuffer) {
    return failure(ErrorCode::invalid_argument);
  }
  if (const auto requested = DoRequest(request); !requested) {
    return requested;
  }
  count_ = lines.size();
  outputs_ = 0;
  watches_edges_ = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].direction == GpioDirection::output) {
      outputs_ |= std::uint64_t{1} << i;
    }
    watches_edges_ = watches_edges_ || lines[i].edges != GpioEdges::none;
  }
  return {};
}

void GpioLines::release() {
  if (count_ != 0) {
    DoRelease();
    count_ = 0;
  }
}

Result<std::uint64_t> GpioLines::get(std::uint64_t mask) {
  if (count_ == 0) {
    return failure(ErrorCode::invalid_state);
  }
  if (mask == 0 || (mask & ~first_bits(count_)) != 0) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoGet(mask);
}

Result<void> GpioLines::set(std::uint64_t mask, std::uint64_t values) {
  if (count_ == 0) {
    return failure(ErrorCode::invalid_state);
  }
  if (mask == 0 || (mask & ~outputs_) != 0) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoSet(mask, values);
}

Result<std::size_t> GpioLines::read_edges(std::span<GpioEdgeEvent> events, TimeNs deadline_ns) {
  if (count_ == 0 || !watches_edges_) {
    return failure(ErrorCode::invalid_state);
  }
  if (events.empty()) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoReadEdges(events, deadline_ns);
}

}  // namespace tactus::hal
