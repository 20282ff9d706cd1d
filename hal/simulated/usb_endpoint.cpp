#include "hal/simulated/usb_endpoint.h"

#include <algorithm>

namespace tactus::hal {

SimulatedUsbEndpoint::SimulatedUsbEndpoint(SimulatedClock& clock, SimulatedUsbPeer& peer,
                                           const SimulatedUsbConfig& config)
    : clock_(clock), peer_(peer), config_(config) {
  config_.max_packet_bytes = std::clamp(config_.max_packet_bytes, std::size_t{1}, kMaxPacketBytes);
  clock_.attach(*this);
}

SimulatedUsbEndpoint::~SimulatedUsbEndpoint() {
  clock_.detach(*this);
}

bool SimulatedUsbEndpoint::answer(std::span<const std::byte> bytes, TimeNs delay_ns) {
  const std::size_t packet_bytes = config_.max_packet_bytes;
  const std::size_t needed =
      std::max<std::size_t>(1, (bytes.size() + packet_bytes - 1) / packet_bytes);
  if (plug_.cable != Cable::in || packets_.size() + needed > kMaxPackets) {
    return false;
  }
  for (std::size_t i = 0; i < needed; ++i) {
    const auto part =
        bytes.subspan(i * packet_bytes, std::min(packet_bytes, bytes.size() - i * packet_bytes));
    Packet packet;
    packet.ready_ns = clock_.now_ns() + delay_ns;
    packet.size = part.size();
    std::ranges::copy(part, packet.bytes.begin());
    packets_.push(packet);
  }
  serve();
  return true;
}

void SimulatedUsbEndpoint::set_stopped(bool stopped) {
  faults_.is_stopped = stopped;
  serve();
}

void SimulatedUsbEndpoint::take_only(std::size_t bytes) {
  faults_.will_take = bytes;
  serve();
}

void SimulatedUsbEndpoint::set_halted(bool halted) {
  faults_.is_halted = halted;
  if (halted) {
    fail_all(ErrorCode::stalled);
  }
}

void SimulatedUsbEndpoint::fail_next(std::uint32_t count, ErrorCode code) {
  faults_.failing = count;
  faults_.failure_code = code;
}

void SimulatedUsbEndpoint::unplug(TimeNs departure_ns) {
  plug_.cable = Cable::out;
  plug_.departure_ns = clock_.now_ns() + departure_ns;
  packets_.clear();
  // Linux reports most transfers of a device just unplugged as io, before it notices the departure.
  fail_all(departure_ns > 0 ? ErrorCode::io : ErrorCode::disconnected);
}

void SimulatedUsbEndpoint::plug_in() {
  if (plug_.cable == Cable::out) {
    plug_.cable = Cable::back;
  }
}

UsbState SimulatedUsbEndpoint::current_state() const {
  if (plug_.cable == Cable::in ||
      (plug_.cable == Cable::out && clock_.now_ns() < plug_.departure_ns)) {
    return UsbState::attached;
  }
  return plug_.cable == Cable::out ? UsbState::detached : UsbState::returned;
}

Result<void> SimulatedUsbEndpoint::check_present() const {
  switch (current_state()) {
    case UsbState::attached:
      if (plug_.cable == Cable::out) {
        return failure(ErrorCode::io);
      }
      return {};
    case UsbState::returned:
      return failure(ErrorCode::invalid_state);
    case UsbState::detached:
      break;
  }
  return failure(ErrorCode::disconnected);
}

Result<void> SimulatedUsbEndpoint::DoReopen() {
  if (plug_.cable == Cable::out) {
    return failure(ErrorCode::disconnected);
  }
  if (plug_.cable == Cable::back) {
    plug_.cable = Cable::in;
    faults_.is_halted = false;
  }
  return {};
}

Result<void> SimulatedUsbEndpoint::wait_for_device(TimeNs deadline_ns) {
  if (!clock_.wait_until(deadline_ns,
                         [this] { return !faults_.is_stopped || plug_.cable != Cable::in; })) {
    return failure(ErrorCode::timeout);
  }
  return check_present();
}

Result<std::size_t> SimulatedUsbEndpoint::DoControlOut(const UsbSetup& setup,
                                                       std::span<const std::byte> data,
                                                       TimeNs deadline_ns) {
  if (const auto there = wait_for_device(deadline_ns); !there) {
    return std::unexpected(there.error());
  }
  return peer_.control_out(setup, data);
}

Result<std::size_t> SimulatedUsbEndpoint::DoControlIn(const UsbSetup& setup,
                                                      std::span<std::byte> buffer,
                                                      TimeNs deadline_ns) {
  if (const auto there = wait_for_device(deadline_ns); !there) {
    return std::unexpected(there.error());
  }
  return peer_.control_in(setup, buffer);
}

Result<void> SimulatedUsbEndpoint::DoSubmit(UsbTransfer& transfer) {
  if (const auto there = check_present(); !there) {
    return there;
  }
  if (flights_.full()) {
    return failure(ErrorCode::queue_full);
  }
  TimeNs due_ns = clock_.now_ns();
  if (transfer.direction() == UsbDirection::out) {
    due_ns = std::max(due_ns, last_due_ns_) + config_.out_time_ns;
    last_due_ns_ = due_ns;
  }
  flights_.add({.transfer = &transfer, .due_ns = due_ns});
  if (faults_.failing > 0) {
    --faults_.failing;
    finish(transfer, failure(faults_.failure_code));
  } else if (faults_.is_halted) {
    finish(transfer, failure(ErrorCode::stalled));
  } else {
    serve();
  }
  return {};
}

void SimulatedUsbEndpoint::DoWait(UsbTransfer& transfer, TimeNs deadline_ns) {
  clock_.wait_until(deadline_ns,
                    [&transfer] { return transfer.state() == UsbTransfer::State::done; });
}

void SimulatedUsbEndpoint::DoCancel(UsbTransfer& transfer) {
  finish(transfer, failure(ErrorCode::cancelled));
}

TimeNs SimulatedUsbEndpoint::next_event_ns() const {
  if (faults_.is_stopped) {
    return kForever;
  }
  TimeNs next_ns = kForever;
  if (const auto* const out = flights_.oldest(UsbDirection::out);
      out != nullptr && faults_.will_take > 0) {
    next_ns = out->due_ns;
  }
  if (flights_.oldest(UsbDirection::in) != nullptr && !packets_.empty()) {
    next_ns = std::min(next_ns, packets_.front().ready_ns);
  }
  return next_ns;
}

// Serves the transfers. The peer may answer meanwhile; the running loop serves its answers too.
void SimulatedUsbEndpoint::serve() {
  if (serving_) {
    return;
  }
  serving_ = true;
  while (!faults_.is_stopped && (serve_out() || serve_in())) {
  }
  serving_ = false;
}

bool SimulatedUsbEndpoint::serve_out() {
  const auto* const flight = flights_.oldest(UsbDirection::out);
  if (flight == nullptr || flight->due_ns > clock_.now_ns()) {
    return false;
  }
  UsbTransfer& transfer = *flight->transfer;
  const auto rest = transfer.out_data().subspan(transfer.transferred());
  const auto part = rest.first(std::min(rest.size(), faults_.will_take));
  if (part.empty() && !rest.empty()) {
    return false;
  }
  if (faults_.will_take != kTakeAll) {
    faults_.will_take -= part.size();
  }
  transfer.progress(part.size());
  if (part.size() == rest.size()) {
    finish(transfer, {});
  }
  peer_.bulk_out(part);
  return true;
}

bool SimulatedUsbEndpoint::serve_in() {
  const auto* const flight = flights_.oldest(UsbDirection::in);
  if (flight == nullptr || packets_.empty() || packets_.front().ready_ns > clock_.now_ns()) {
    return false;
  }
  UsbTransfer& transfer = *flight->transfer;
  const Packet& packet = packets_.front();
  const auto room = transfer.in_buffer().subspan(transfer.transferred());
  const bool fits = packet.size <= room.size();
  if (fits) {
    std::ranges::copy(std::span(packet.bytes).first(packet.size), room.begin());
    transfer.progress(packet.size);
  }
  const bool short_packet = packet.size < config_.max_packet_bytes;
  packets_.pop();
  if (!fits) {
    finish(transfer, failure(ErrorCode::overflow));
  } else if (short_packet || transfer.transferred() == transfer.in_buffer().size()) {
    finish(transfer, {});
  }
  return true;
}

void SimulatedUsbEndpoint::finish(UsbTransfer& transfer, Result<void> outcome) {
  flights_.remove(transfer);
  transfer.finish(outcome);
}

void SimulatedUsbEndpoint::fail_all(ErrorCode code) {
  while (!flights_.empty()) {
    finish(flights_.oldest(), failure(code));
  }
}

}  // namespace tactus::hal
