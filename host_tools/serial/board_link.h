// Messages to a board and from it over a serial line. Bytes between the frames are the board's
// lines of text. One thread at a time; not real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/line/frame.h"
#include "firmware/line/message.h"
#include "hal/clock.h"
#include "host_tools/serial/serial_line.h"

namespace tactus::host {

// The line with its framing. Its functions throw UnreachableError if the line is lost.
class BoardLink {
 public:
  // The receiver of a message's bytes, which are valid during the call.
  using Hear = std::function<void(std::span<const std::byte>)>;
  // The receiver of a line of text, without its end.
  using HearText = std::function<void(std::string_view)>;

  // Opens the line. Without a receiver the texts are dropped.
  explicit BoardLink(const SerialPlace& place, HearText text = {});

  // Sends a message of firmware/line/message.h.
  template <class Message>
  void send(const Message& message) {
    std::array<std::byte, firmware::kMaxMessage> room{};
    write(firmware::write_message(message, room));
  }

  // Waits until bytes come or the deadline has passed, and hands over what they complete.
  void listen(hal::TimeNs deadline_ns, const Hear& hear);

  // Returns the time at which the last whole message came, ns of hal::monotonic_now_ns; that of the
  // opening before the first.
  [[nodiscard]] hal::TimeNs heard_ns() const { return heard_ns_; }
  // Returns the number of frames that were broken.
  [[nodiscard]] std::uint32_t broken() const { return reader_.broken(); }
  // Returns the number of bytes that came.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] const std::string& name() const { return line_.name(); }
  // Returns the rate of a tty, bit/s.
  [[nodiscard]] std::uint32_t baud() const { return line_.baud(); }

 private:
  void write(std::span<const std::byte> message);
  void add_text(std::string_view text);

  SerialLine line_;
  firmware::FrameReader reader_;
  HearText text_;
  std::string text_line_;
  std::vector<std::byte> frame_;
  std::uint64_t bytes_ = 0;
  hal::TimeNs heard_ns_ = hal::monotonic_now_ns();
};

}  // namespace tactus::host
