#include "drivers/falcon_usb/link.h"

namespace tactus::drivers {

hal::Result<void> FalconLink::start_reads() {
  next_read_ = 0;
  blocked_in_a_row_ = 0;
  hal::Result<void> outcome;
  for (Read& read : reads_) {
    if (const auto submitted = endpoint_->submit(read.transfer); !submitted && outcome) {
      outcome = submitted;
    }
  }
  return outcome;
}

void FalconLink::withdraw_all() {
  for (Read& read : reads_) {
    endpoint_->cancel(read.transfer);
  }
  for (Write& write : writes_) {
    endpoint_->cancel(write.transfer);
    write.on_its_way = false;
  }
}

hal::Result<std::optional<std::span<const std::byte>>> FalconLink::receive(
    hal::TimeNs deadline_ns) {
  Read& read = reads_[next_read_];
  if (read.transfer.state() == hal::UsbTransfer::State::idle) {
    return std::nullopt;
  }
  const auto got = endpoint_->wait(read.transfer, deadline_ns);
  if (read.transfer.state() == hal::UsbTransfer::State::in_flight) {
    return std::nullopt;
  }
  if (!got) {
    return std::unexpected(got.error());
  }
  return std::span<const std::byte>(read.buffer).first(*got);
}

hal::Result<void> FalconLink::read_on() {
  Read& read = reads_[next_read_];
  next_read_ = (next_read_ + 1) % reads_.size();
  return endpoint_->submit(read.transfer);
}

hal::Result<void> FalconLink::check_writes() {
  hal::Result<void> outcome;
  for (Write& write : writes_) {
    if (!write.on_its_way) {
      continue;
    }
    const auto sent = endpoint_->wait(write.transfer, hal::kNoWait);
    write.on_its_way = write.transfer.state() == hal::UsbTransfer::State::in_flight;
    if (!sent && !write.on_its_way && outcome) {
      outcome = std::unexpected(sent.error());
    }
  }
  return outcome;
}

hal::Result<void> FalconLink::send(const FalconPacket& packet) {
  Write& write = writes_[next_write_];
  next_write_ = (next_write_ + 1) % writes_.size();
  blocked_in_a_row_ = 0;
  write.packet = packet;
  write.on_its_way = true;
  return endpoint_->submit(write.transfer);
}

void FalconLink::wait_for(std::size_t place, hal::TimeNs deadline_ns) {
  (void)endpoint_->wait(writes_[place].transfer, deadline_ns);
}

}  // namespace tactus::drivers
