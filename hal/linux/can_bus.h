// A CAN interface of a Linux machine, through SocketCAN. Errors and threads are those of CanBus.
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

// One raw socket on one interface. Several programs may share an interface, each with its own
// filters. The node does not receive its own frames. hal/README.md says how the kernel behaves and
// which calls are used.
class LinuxCanBus final : public CanBus {
 public:
  LinuxCanBus() = default;
  LinuxCanBus(const LinuxCanBus&) = delete;
  LinuxCanBus& operator=(const LinuxCanBus&) = delete;
  ~LinuxCanBus() = default;

  // Opens an interface, such as "can0"; also again after the interface was gone. Filters and error
  // classes are then those of a new socket. An interface that is down is no error: `send` and
  // `receive` return link_down until it is up. Not real time.
  //   not_found         no such interface
  //   invalid_argument  it is no CAN interface, or its name is too long
  //   not_supported     the kernel has no CAN, or no raw CAN (modprobe can-raw)
  //   not_permitted, no_memory, io
  Result<void> open(std::string_view interface);
  // Closes the socket. `send` and `receive` then return `disconnected`.
  void close() { socket_.reset(); }
  // Returns the socket's descriptor, to wait for several buses at once: it is readable when
  // `receive` has something to return. -1 while closed.
  [[nodiscard]] int descriptor() const { return socket_.get(); }

 private:
  // The number of frames that one system call carries.
  static constexpr std::size_t kBatch = 32;

  Result<std::size_t> DoSend(std::span<const CanFrame> frames) override;
  Result<std::size_t> DoReceive(std::span<CanReceived> received, TimeNs deadline_ns) override;
  Result<void> DoSetFilters(std::span<const CanFilter> filters) override;
  Result<void> DoSetErrorClasses(std::uint32_t classes) override;
  Result<void> DoRestart() override;
  CanStatus DoStatus() const override { return status_; }
  std::uint64_t DoReceiveDropped() const override { return receive_dropped_; }
  bool DoFdEnabled() const override { return interface_.fd(); }

  // Sets the options of a new socket and binds it to the interface.
  Result<void> configure_socket();
  Result<std::size_t> take_waiting(std::span<CanReceived> received);
  Result<void> may_send_again(int error, bool& was_down);
  Result<void> check_link();
  bool hand_out(CanReceived& item);
  // Takes the socket's count of dropped frames so far.
  void note_drops(std::uint32_t total);
  // Takes the state and the counters that a report holds.
  void note(const CanErrorReport& report);

  CanInterface interface_;
  FileDescriptor socket_;
  CanStatus status_;
  // The CanErrorClass bits that the caller enabled.
  std::uint32_t error_classes_ = 0;
  std::uint64_t receive_dropped_ = 0;
  // The socket's own count of dropped frames when it was last read. It wraps at 2^32.
  std::uint32_t drops_seen_ = 0;
  // True if the link was down at the last look: the next call looks again.
  bool link_down_ = false;
};

}  // namespace tactus::hal
