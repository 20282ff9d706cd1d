#include "hal/simulated/serial_port.h"

#include <algorithm>

namespace tactus::hal {

SimulatedSerialPort::SimulatedSerialPort(SimulatedClock& clock, const SimulatedSerialConfig& config)
    : clock_(clock), config_(config) {
  clock_.attach(*this);
}

SimulatedSerialPort::~SimulatedSerialPort() {
  clock_.detach(*this);
}

void SimulatedSerialPort::connect(SimulatedSerialPort& other) {
  other_ = &other;
  other.other_ = this;
}

void SimulatedSerialPort::fail_next(std::uint32_t count, ErrorCode code) {
  failing_ = count;
  failure_code_ = code;
}

void SimulatedSerialPort::unplug() {
  plug_ = Plug::out;
  line_.clear();
  input_.clear();
}

void SimulatedSerialPort::plug_in() {
  if (plug_ == Plug::out) {
    plug_ = Plug::back;
  }
}

Result<void> SimulatedSerialPort::check() {
  if (plug_ != Plug::in) {
    return failure(ErrorCode::disconnected);
  }
  if (failing_ > 0) {
    --failing_;
    return failure(failure_code_);
  }
  return {};
}

std::size_t SimulatedSerialPort::room() const {
  if (other_ == nullptr || other_->plug_ != Plug::in) {
    return will_take_;
  }
  // Bytes on the line count as well, so that the other end's buffers cannot overflow when they
  // arrive.
  const std::size_t used = other_->line_.size() + other_->input_.size();
  return std::min(will_take_, kBufferBytes - std::min(used, kBufferBytes));
}

void SimulatedSerialPort::carry(std::byte byte) {
  line_free_ns_ = std::max(line_free_ns_, clock_.now_ns()) + config_.byte_time_ns;
  if (other_ != nullptr && other_->plug_ == Plug::in) {
    other_->line_.push({line_free_ns_ + config_.latency_ns, byte});
  }
}

Result<std::size_t> SimulatedSerialPort::DoWrite(std::span<const std::byte> bytes,
                                                 TimeNs deadline_ns) {
  if (const auto well = check(); !well) {
    return std::unexpected(well.error());
  }
  std::size_t taken = 0;
  while (taken < bytes.size()) {
    if (!clock_.wait_until(deadline_ns, [this] { return room() > 0; })) {
      break;
    }
    const auto part = bytes.subspan(taken, std::min(room(), bytes.size() - taken));
    std::ranges::for_each(part, [this](std::byte byte) { carry(byte); });
    taken += part.size();
    if (will_take_ != kTakeAll) {
      will_take_ -= part.size();
    }
  }
  if (taken == 0) {
    return failure(ErrorCode::timeout);
  }
  return taken;
}

Result<std::size_t> SimulatedSerialPort::DoRead(std::span<std::byte> buffer, TimeNs deadline_ns) {
  if (const auto well = check(); !well) {
    return std::unexpected(well.error());
  }
  const auto ready = [this] {
    run_event();
    return !input_.empty() || plug_ != Plug::in;
  };
  if (!clock_.wait_until(deadline_ns, ready)) {
    return failure(ErrorCode::timeout);
  }
  if (plug_ != Plug::in) {
    return failure(ErrorCode::disconnected);
  }
  std::size_t got = 0;
  for (; got < buffer.size() && !input_.empty(); ++got) {
    buffer[got] = input_.front();
    input_.pop();
  }
  return got;
}

Result<void> SimulatedSerialPort::DoDiscardInput() {
  if (plug_ != Plug::in) {
    return failure(ErrorCode::disconnected);
  }
  run_event();
  input_.clear();
  return {};
}

Result<void> SimulatedSerialPort::DoReopen() {
  if (plug_ == Plug::out) {
    return failure(ErrorCode::disconnected);
  }
  plug_ = Plug::in;
  input_.clear();
  return {};
}

TimeNs SimulatedSerialPort::next_event_ns() const {
  return line_.empty() ? kForever : line_.front().arrives_ns;
}

void SimulatedSerialPort::run_event() {
  while (!line_.empty() && line_.front().arrives_ns <= clock_.now_ns()) {
    input_.push(line_.front().byte);
    line_.pop();
  }
}

}  // namespace tactus::hal
