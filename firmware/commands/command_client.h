// One program that is connected to the command socket: its lines on their way in, its reply on the
// way out, and what it waits for. Fixed room; the command thread's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/commands/command.h"
#include "firmware/commands/command_line.h"
#include "firmware/commands/text_line.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

class CommandClient {
 public:
  void connect(hal::FileDescriptor socket);
  void disconnect();
  [[nodiscard]] bool is_connected() const { return socket_.is_open(); }
  [[nodiscard]] int descriptor() const { return socket_.get(); }

  // Whether there is room for more, and more to come.
  [[nodiscard]] bool listens() const { return !has_ended_ && size_ < in_.size(); }
  // Takes what has come, if it listens. False: the connection is broken.
  bool receive();
  // It will say no more, and everything it said has been answered.
  [[nodiscard]] bool is_done() const;

  // The oldest complete line without its newline, valid until drop_line; nothing if there is none.
  [[nodiscard]] std::optional<std::string_view> line() const;
  void drop_line();
  // All that has come so far.
  [[nodiscard]] std::string_view received() const { return {in_.data(), size_}; }

  // True once after a line that was too long: it is skipped up to its newline.
  bool take_overlong();

  // The reply under way; written by send.
  [[nodiscard]] TextLine& out() { return out_; }
  [[nodiscard]] bool has_sent() const { return out_.empty(); }
  // Sends what fits. False: the program has gone, or has not read for kPatience_ns.
  bool send(hal::TimeNs now_ns);

  static constexpr hal::TimeNs kPatience_ns = 2 * hal::kNsPerSecond;
  hal::TimeNs last_heard_ns = 0;

  // What it waits for.
  struct Waiting {
    Ticket ticket = 0;       // of the tick's answer; 0: for none
    Command command;         // that the tick answers
    bool is_posted = false;  // it has left for the desk; else there was no room for it yet
    Verb verb = Verb::help;  // `list` and `scene` take several answers
    bool is_under_way = false;
    std::array<char, kMaxCommandLine> file{};  // of `scene`
    hal::TimeNs deadline_ns = 0;
    std::uint32_t listed = 0;  // of `list`
    bool is_asking = false;    // of `scene`: for the mode, before the file is opened
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
