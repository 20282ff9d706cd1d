#include "hal/simulated/gpio_lines.h"

#include <algorithm>
#include <bit>

namespace tactus::hal {

namespace {

constexpr TimeNs kNsPerUs = 1000;

bool watches(GpioEdges edges, bool rising) {
  return edges == GpioEdges::both || edges == (rising ? GpioEdges::rising : GpioEdges::falling);
}

}  // namespace

SimulatedGpioLines::SimulatedGpioLines(SimulatedGpioChip& chip) : chip_(chip) {
  chip_.clock().attach(*this);
}

SimulatedGpioLines::~SimulatedGpioLines() {
  release();
  chip_.clock().detach(*this);
}

Result<void> SimulatedGpioLines::DoRequest(const GpioRequest& request) {
  if (!chip_.present_) {
    return failure(ErrorCode::disconnected);
  }
  for (const GpioLineConfig& line : request.lines) {
    if (line.offset >= chip_.line_count_) {
      return failure(ErrorCode::not_found);
    }
    if (chip_.pins_[line.offset].holder != nullptr) {
      return failure(ErrorCode::busy);
    }
  }
  held_ = request.lines.size();
  const std::size_t wanted =
      request.edge_buffer != 0 ? request.edge_buffer : held_ * kGpioEdgesPerLine;
  edge_capacity_ = std::bit_ceil(wanted);  // as the kernel's buffer
  edges_.clear();
  sequence_ = 0;
  for (std::size_t i = 0; i < held_; ++i) {
    claim(i, request.lines[i]);
  }
  return {};
}

void SimulatedGpioLines::claim(std::size_t index, const GpioLineConfig& config) {
  SimulatedGpioChip::Pin& pin = chip_.pins_[config.offset];
  pin.holder = this;
  pin.index = index;
  pin.config = config;
  pin.output_active = config.initial_active;
  pin.level = SimulatedGpioChip::resolve(pin);
  lines_[index] = {.config = config, .settled = pin.level, .settles_ns = kForever, .sequence = 0};
}

void SimulatedGpioLines::DoRelease() {
  for (std::size_t i = 0; i < held_; ++i) {
    const std::uint32_t offset = lines_[i].config.offset;
    chip_.pins_[offset].holder = nullptr;
    chip_.update(offset);
  }
  held_ = 0;
}

Result<std::uint64_t> SimulatedGpioLines::DoGet(std::uint64_t mask) {
  if (!chip_.present_) {
    return failure(ErrorCode::disconnected);
  }
  std::uint64_t values = 0;
  for (std::size_t i = 0; i < held_; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    const Line& line = lines_[i];
    const bool level = line.config.debounce_us > 0 ? line.settled : chip_.level(line.config.offset);
    if ((mask & bit) != 0 && level != line.config.active_low) {
      values |= bit;
    }
  }
  return values;
}

Result<void> SimulatedGpioLines::DoSet(std::uint64_t mask, std::uint64_t values) {
  if (!chip_.present_) {
    return failure(ErrorCode::disconnected);
  }
  for (std::size_t i = 0; i < held_; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if ((mask & bit) != 0) {
      const std::uint32_t offset = lines_[i].config.offset;
      chip_.pins_[offset].output_active = (values & bit) != 0;
      chip_.update(offset);
    }
  }
  return {};
}

Result<std::size_t> SimulatedGpioLines::DoReadEdges(std::span<GpioEdgeEvent> events,
                                                    TimeNs deadline_ns) {
  chip_.clock().wait_until(deadline_ns, [this] { return !edges_.empty() || !chip_.present_; });
  if (!chip_.present_) {
    return failure(ErrorCode::disconnected);
  }
  std::size_t count = 0;
  while (count < events.size() && !edges_.empty()) {
    events[count] = edges_.front();
    edges_.pop();
    ++count;
  }
  if (count == 0) {
    return failure(ErrorCode::timeout);
  }
  return count;
}

void SimulatedGpioLines::level_changed(std::size_t index, bool level) {
  Line& line = lines_[index];
  if (line.config.debounce_us > 0) {
    line.settles_ns = chip_.clock().now_ns() + line.config.debounce_us * kNsPerUs;
  } else {
    report_edge(line, level);
  }
}

TimeNs SimulatedGpioLines::next_event_ns() const {
  TimeNs next_ns = kForever;
  for (std::size_t i = 0; i < held_; ++i) {
    next_ns = std::min(next_ns, lines_[i].settles_ns);
  }
  return next_ns;
}

void SimulatedGpioLines::run_event() {
  for (std::size_t i = 0; i < held_; ++i) {
    Line& line = lines_[i];
    if (line.settles_ns > chip_.clock().now_ns()) {
      continue;
    }
    line.settles_ns = kForever;
    const bool level = chip_.level(line.config.offset);
    if (level != line.settled) {
      line.settled = level;
      report_edge(line, level);
    }
  }
}

void SimulatedGpioLines::report_edge(Line& line, bool level) {
  const bool rising = level != line.config.active_low;
  if (!watches(line.config.edges, rising)) {
    return;
  }
  ++sequence_;
  ++line.sequence;
  if (losing_ > 0) {
    --losing_;
    return;
  }
  if (edges_.size() == edge_capacity_) {
    edges_.pop();
  }
  edges_.push({.time_ns = chip_.clock().now_ns(),
               .offset = line.config.offset,
               .sequence = sequence_,
               .line_sequence = line.sequence,
               .rising = rising});
}

}  // namespace tactus::hal
