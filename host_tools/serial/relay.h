// Carries commands from the command queue over the line to the board, and its answers back. The
// gateway's thread.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "firmware/commands/command_queue.h"
#include "firmware/line/message.h"
#include "firmware/telemetry/telemetry_event.h"
#include "hal/clock.h"
#include "hal/linux/system.h"

namespace tactus::host {

// The relay of one board. A message that the line loses has no answer: a stop is sent again until
// it has one, and the command socket refuses any other command after a second.
class Relay {
 public:
  // The senders of a message; they are called in the caller's thread.
  struct Senders {
    std::function<void(const firmware::LineStop&)> stop;
    std::function<void(const firmware::Command&)> command;
  };

  // The queue outlives the relay. `most_waiting` is the number of commands that the board takes
  // before it has answered them.
  Relay(firmware::CommandQueue& queue, Senders senders, std::size_t most_waiting);

  // Sends what waits: a stop before a request, a request before all other commands.
  void send_waiting(hal::TimeNs now_ns);

  // Takes the board's answer to its command. An answer that nobody waits for is dropped. Returns
  // the event for the telemetry if the command took effect.
  std::optional<firmware::TelemetryEvent> take(const firmware::Answer& answer);

 private:
  struct Sent {
    firmware::Command command;
    hal::TimeNs sent_ns = 0;
  };

  void send(const firmware::Command& command, hal::TimeNs now_ns);
  void send_stop(hal::TimeNs now_ns);
  // Gives up the commands that were sent too long ago.
  void give_up(hal::TimeNs now_ns);
  // Returns the number of commands under way that are no requests.
  [[nodiscard]] std::size_t waiting() const;

  firmware::CommandQueue& queue_;
  Senders senders_;
  std::size_t most_waiting_;
  std::vector<Sent> sent_;
  // The time at which the stop without an answer was sent last; nothing if there is none.
  std::optional<hal::TimeNs> stop_sent_ns_;
};

// The ticket of a stop. The command socket gives it to one command in millions.
inline constexpr firmware::Ticket kStopTicket = firmware::kLargestTicket;
// A stop without an answer is sent again after so long.
inline constexpr hal::TimeNs kStopAgain_ns = hal::kNsPerSecond / 50;

}  // namespace tactus::host
