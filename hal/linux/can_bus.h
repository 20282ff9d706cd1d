// A CAN interface of a Linux machine, through SocketCAN.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/can_bus.h"
#include "hal/linux/can_interface.h"
#include "hal/linux/system.h"

namespace tactus::hal {

// It uses one raw socket on one interface. Several programs may share an interface, each with its
// own filters. The node does not receive its own frames. hal/README.md describes the behaviour of
// the system.
class LinuxCanBus final : public CanBus {
 public:
  LinuxCanBus() = default;
  LinuxCanBus(const LinuxCanBus&) = delete;
  LinuxCanBus& operator=(const LinuxCanBus&) = delete;
  ~LinuxCanBus() = default;

  // Opens an interface, such as "can0"; also again after the interface was gone. An interface that
  // is down is no error: `send` and `receive` return link_down until it is up.
  //   not_found         no such interface
  //   invalid_argument  it is no CAN interface, or its name is too long
  //   not_supported     the kernel has no CAN, or no raw CAN (modprobe can-raw)
  //   not_permitted, no_memory, io
  Result<void> open(std::string_view interface);
  void close() { socket_.reset(); }

 private:
  static constexpr std::size_t kBatch = 32;  // frames per system call

  Result<std::size_t> DoSend(std::span<const CanFrame> frames) override;
  Result<std::size_t> DoReceive(std::span<CanReceived> received, TimeNs deadline_ns) override;
  Result<void> DoSetFilters(std::span<const CanFilter> filters) override;
  Result<void> DoSetErrorClasses(std::uint32_t classes) override;
  Result<void> DoRestart() override;
  CanStatus DoStatus() const override { return status_; }
  std::uint64_t DoReceiveDropped() const override { return receive_dropped_; }
  bool DoFdEnabled() const override { return interface_.fd(); }

  Result<void> configure_socket();
  Result<std::size_t> take_waiting(std::span<CanReceived> received);
  Result<void> may_send_again(int error, int tries);
  Result<void> check_link();
  bool hand_out(CanReceived& item);
  void note_drops(std::uint32_t total);
  void note(const CanErrorReport& report);

  CanInterface interface_;
  FileDescriptor socket_;
  CanStatus status_;
  std::uint32_t error_classes_ = 0;  // CanErrorClass bits that the caller enabled
  std::uint64_t receive_dropped_ = 0;
  std::uint32_t drops_seen_ = 0;  // the socket's own count, which wraps
  bool link_down_ = false;
};

}  // namespace tactus::hal
