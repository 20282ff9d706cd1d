// A board's end of its serial line to a host: takes the host's messages, hands commands to the
// tick, and answers (firmware/line). It calls no board. One thread; real time: the work of each
// call is bounded.
//
// Without a host it changes nothing: the request of a tick is then the one that brings the
// controller closer to force. After the host's first request only the host asks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/bare_metal/line_queue.h"
#include "firmware/commands/command_queue.h"
#include "firmware/control/controller.h"
#include "firmware/line/frame.h"
#include "firmware/line/message.h"
#include "firmware/telemetry/recorded_tick.h"

namespace tactus::firmware {

// The facts of a board that its hello tells, and the images that it gives away. All of it outlives
// the HostLine.
struct BoardFacts {
  std::string_view board;
  std::span<const std::byte> device_image;
  std::span<const std::byte> scene_image;
  double rate_hz = 0.0;
  std::size_t joints = 0;
};

class HostLine {
 public:
  // The characters that ticks and images leave free for answers and lines of text.
  static constexpr std::size_t kSpareBytes = 700;

  explicit HostLine(const BoardFacts& facts);

  // Takes a character from the host. Answers that are known at once go to `out`.
  void hear(char character, LineQueue& out);

  // Returns true while the host asks for ticks.
  [[nodiscard]] bool wants_ticks() const { return every_ != 0; }

  // Carries out the host's next command. Returns the request of the tick. Call it before a tick.
  Request before_tick(Controller& controller);

  // Returns the LoopStatus of the tick: kLoopLineLost in the first one after the supervising host
  // has been silent for too long. Call it once a tick.
  std::uint32_t line_status();

  // Sends what there is to send after a tick, as far as `out` has room: answers, the tick if it was
  // asked for, a part of an image. `lost_bytes` is the number of characters of the host that came
  // too fast for the board.
  void after_tick(const Controller& controller, const LoopTimes& times, std::uint32_t lost_bytes,
                  LineQueue& out);

 private:
  // The host's stop that has no answer yet.
  struct OpenStop {
    Ticket ticket = 0;
    std::uint32_t number = 0;
  };

  void take(std::span<const std::byte> message, LineQueue& out);
  void take_command(const Command& command, LineQueue& out);
  void end_requests();

  // Returns true if the host wants the tick of that number.
  [[nodiscard]] bool is_asked_for(std::uint64_t tick) const;
  // Counts that tick as left out if the host wants it.
  void skip_tick(std::uint64_t tick);

  // These send one message each if it is due. The first two return false if `out` had no room.
  bool send_stop_answer(const Controller& controller, LineQueue& out);
  bool send_answers(LineQueue& out);
  void send_hello(const Controller& controller, std::uint32_t lost_bytes, LineQueue& out);
  // Returns true if it was sent.
  bool send_tick(const Controller& controller, const LoopTimes& times, LineQueue& out);
  void send_image_part(LineQueue& out);

  // Sends a message, and returns false if there was no room for it and `spare` characters.
  template <class Message>
  bool send(const Message& message, std::size_t spare, LineQueue& out);

  BoardFacts facts_;
  std::uint32_t timeout_ticks_;
  FrameReader reader_;
  CommandQueue queue_;
  std::optional<OpenStop> stop_;
  std::optional<Answer> waiting_answer_;
  Mode before_ = Mode::init;
  bool owes_hello_ = false;
  std::uint32_t every_ = 0;
  AskImage asked_;
  RecordedTick tick_;

  // The ticks since the last message, counted while the host supervises.
  bool is_supervised_ = false;
  // The line was found lost, and the last tick that was asked for is still to be sent.
  bool is_lost_ = false;
  std::uint32_t silent_ticks_ = 0;

  std::array<std::byte, kMaxMessage> message_{};
};

}  // namespace tactus::firmware
