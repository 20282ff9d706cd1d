// One program that is connected to the command socket: the lines received from it, the reply being
// sent to it, and the command whose answer it waits for. All buffers have a fixed size. Only the
// command thread uses it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/linux/commands/command.h"
#include "firmware/linux/commands/command_line.h"
#include "firmware/linux/commands/text_line.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

class CommandClient {
 public:
  void connect(hal::FileDescriptor socket);
  void disconnect();
  [[nodiscard]] bool is_connected() const { return socket_.is_open(); }
  [[nodiscard]] int descriptor() const { return socket_.get(); }

  // Returns true if the buffer has room and the program may still send.
  [[nodiscard]] bool listens() const { return !has_ended_ && size_ < in_.size(); }
  // Receives the bytes that have come, if it listens. Returns false if the connection is broken.
  bool receive();
  // Returns true if the program will send no more and has got all its replies.
  [[nodiscard]] bool is_done() const;

  // Returns the oldest complete line without its newline, or nothing if there is none. The view is
  // valid until drop_line.
  [[nodiscard]] std::optional<std::string_view> line() const;
  void drop_line();
  // Returns all bytes received and not dropped yet.
  [[nodiscard]] std::string_view received() const { return {in_.data(), size_}; }

  // Returns true once after a line that was too long. Such a line is skipped up to its newline.
  bool take_overlong();

  // Returns the reply to be sent; `send` empties it.
  [[nodiscard]] TextLine& out() { return out_; }
  [[nodiscard]] bool has_sent() const { return out_.empty(); }
  // Sends as much of the reply as the socket takes. Returns false if the program has gone or has
  // read nothing for kPatience_ns.
  bool send(hal::TimeNs now_ns);

  static constexpr hal::TimeNs kPatience_ns = 2 * hal::kNsPerSecond;
  hal::TimeNs last_heard_ns = 0;

  // The command whose answer the program waits for.
  struct Waiting {
    Ticket ticket = 0;       // ticket of the answer; 0: it waits for no tick
    Command command;         // the command that the tick answers
    bool is_posted = false;  // false: the queue had no room for the command yet
    Verb verb = Verb::help;  // `list` and `scene` take several answers
    bool is_under_way = false;
    std::array<char, kMaxCommandLine> file{};  // used by `scene`: the path, ends with a zero
    hal::TimeNs deadline_ns = 0;
    std::uint32_t listed = 0;  // used by `list`: parameters listed so far
    bool is_asking = false;    // used by `scene`: it asks for the mode before it opens the file
  };
  Waiting waiting;

 private:
  hal::FileDescriptor socket_;
  std::array<char, kMaxCommandLine> in_{};
  std::size_t size_ = 0;
  bool has_ended_ = false;
  bool is_skipping_ = false;
  bool was_overlong_ = false;
  TextLine out_;
  std::size_t sent_ = 0;
  hal::TimeNs stuck_since_ns_ = 0;
};

}  // namespace tactus::firmware
