// One program that is connected to the command socket: the lines received from it, the reply being
// sent to it, and the command whose answer it waits for. All buffers have a fixed size. Only the
// command thread uses it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/commands/command.h"
#include "firmware/linux/commands/command_line.h"
#include "firmware/linux/commands/text_line.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

// The place of one client. A place without a connection is free.
class CommandClient {
 public:
  // Takes over the socket of a program that has connected, after disconnecting the previous one.
  void connect(hal::FileDescriptor socket);
  // Closes the connection and forgets lines, reply and the command that waits.
  void disconnect();
  // Returns true if a program is connected.
  [[nodiscard]] bool is_connected() const { return socket_.is_open(); }
  // Returns the descriptor to wait for; -1 without a connection.
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
  // Removes the oldest line, or all bytes if there is no complete line.
  void drop_line();
  // Returns all bytes received and not dropped yet.
  [[nodiscard]] std::string_view received() const { return {in_.data(), size_}; }

  // Returns true once after a line that was too long. Such a line is skipped up to its newline.
  bool take_overlong();

  // Returns the reply to be sent; `send` empties it.
  [[nodiscard]] TextLine& out() { return out_; }
  // Returns true if no reply waits to be sent.
  [[nodiscard]] bool has_sent() const { return out_.empty(); }
  // Sends as much of the reply as the socket takes. Returns false if the program has gone or has
  // read nothing for kPatience_ns.
  bool send(hal::TimeNs now_ns);

  // The time after which a program that reads none of its reply is disconnected.
  static constexpr hal::TimeNs kPatience_ns = 2 * hal::kNsPerSecond;
  // The time of the last bytes from the program, CLOCK_MONOTONIC.
  hal::TimeNs last_heard_ns = 0;

  // The command whose answer the program waits for.
  struct Waiting {
    // The ticket of the answer; 0: it waits for no tick.
    Ticket ticket = 0;
    // The command that the tick answers.
    Command command;
    // False: the queue had no room for the command yet.
    bool is_posted = false;
    // The verb of the line; `list` and `scene` take several answers.
    Verb verb = Verb::help;
    // True until the reply is complete.
    bool is_under_way = false;
    // Used by `scene`: the path, ended by a zero.
    std::array<char, kMaxCommandLine> file{};
    // The time at which the command is refused without an answer.
    hal::TimeNs deadline_ns = 0;
    // Used by `list`: the number of parameters listed so far.
    std::uint32_t listed = 0;
    // Used by `scene`: it asks for the mode before it opens the file.
    bool is_asking = false;
  };
  Waiting waiting;

 private:
  hal::FileDescriptor socket_;
  // The bytes received and not dropped, and their number.
  std::array<char, kMaxCommandLine> in_{};
  std::size_t size_ = 0;
  // True if the program will send no more.
  bool has_ended_ = false;
  // True while the rest of a line that was too long is dropped.
  bool is_skipping_ = false;
  bool was_overlong_ = false;
  TextLine out_;
  // The number of characters of the reply that are sent.
  std::size_t sent_ = 0;
  // The time since which the socket takes nothing; 0: it takes bytes.
  hal::TimeNs stuck_since_ns_ = 0;
};

// Returns the first word of the line whose answer is waited for.
std::string_view word_of(const CommandClient::Waiting& waiting);

}  // namespace tactus::firmware
