// The queue between the command thread and the loop: commands one way, answers the other.
//
// The command thread posts commands and takes answers. The loop calls before_tick and after_tick.
// There are no locks and no heap, and neither side waits for the other. A request goes through a
// slot in which a newer request replaces an older one, and only an estop replaces an estop. All
// other commands keep their order; the loop takes one per tick.
//
// post_stop bypasses the queue, and any thread may call it.
//
// A relay, whose controller is at the other end of a line, takes the loop's place: it takes
// commands and gives the answers that come back.
//
// No answer is lost as long as the command thread posts at most kMaxRequests requests between two
// times at which it has taken all answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/commands/command.h"
#include "firmware/commands/injection.h"
#include "firmware/commands/request_slot.h"
#include "firmware/commands/stop_slot.h"
#include "firmware/control/controller.h"
#include "firmware/telemetry/ring.h"
#include "firmware/telemetry/telemetry_event.h"
#include "rendering/profiles/chosen_profile.h"

namespace tactus::firmware {

// The largest number of commands whose answers have not been taken yet.
inline constexpr std::size_t kMaxWaiting = rendering::kProfile.waiting_commands;
// The same for requests: the ring of answers has room for both.
inline constexpr std::size_t kMaxRequests =
    rendering::kProfile.waiting_answers - rendering::kProfile.waiting_commands;

// A receiver of events. The loop calls `tell`, so it must be bounded and take no lock. A null
// `tell` drops the events.
struct EventSink {
  // The first argument of `tell`.
  void* to = nullptr;
  void (*tell)(void* to, const TelemetryEvent& event) = nullptr;
};

// The queue of one device of a controller.
class CommandQueue {
 public:
  // Serves the device of that number, 0 for the first and by default. Call before the loop starts.
  void set_device(std::size_t device) { device_ = device; }

  // These two may be called from any thread.

  // Makes the next tick an estop, before anything that waits in the queue. Returns the number of
  // the stop. Any thread.
  std::uint32_t post_stop() { return stops_.post(); }

  // Returns the tick that carried out the stop with that number, or nothing while none has. Any
  // thread.
  [[nodiscard]] std::optional<StopTaken> stop_taken(std::uint32_t stop) const {
    return stops_.taken(stop);
  }

  // These are for the command thread.

  // Returns true if one more command fits. A request always fits.
  [[nodiscard]] bool has_room() const { return waiting_ < kMaxWaiting; }

  // Posts a command. A command other than a request needs has_room(). Returns an answer if one is
  // known at once: to the request that this one replaces, or to this one if an estop waits.
  std::optional<Answer> post(const Command& command);

  // Returns the next answer that a tick has given, or nothing.
  std::optional<Answer> next_answer();

  // These are for the loop's thread.

  // Takes the next command and changes the controller as it says. Call before a tick. Returns the
  // request for the tick, or Request::none.
  Request before_tick(Controller& controller);

  // Answers the request of the tick. Call after a tick.
  void after_tick(const Controller& controller);

  // These are for a relay in place of the loop's thread, which then calls none of the loop's.

  // Returns true if a stop was posted since the last call. Call it again only after answer_stop.
  bool take_stop() { return stops_.take(); }
  // Answers the stops that take_stop has taken.
  void answer_stop(const StopTaken& done) { stops_.answer(done); }
  // Return the newest request, and the next command other than a request; nothing if none waits.
  std::optional<Command> take_request();
  std::optional<Command> take_command();
  // Gives the answer to a command that was taken. Each command other than a request needs one.
  void answer(const Answer& answer) { answers_.push(answer); }

  // Returns true after the first request. Automatic requests (--enable) must stop then.
  [[nodiscard]] bool is_operated() const { return is_operated_; }

  // Returns the injector to put between device and controller. It changes nothing until an
  // `inject` command arrives.
  [[nodiscard]] Injector& injector() { return injector_; }

  // Sets the receiver of an event for each command that took effect. Call before the loop starts.
  void set_events(const EventSink& events) { events_ = events; }

 private:
  // Carries out a command other than a request and answers it.
  void carry_out(const Command& command, Controller& controller);
  void set(const Command& command, Controller& controller, Answer& answer);
  void set_scene(const Command& command, Controller& controller, Answer& answer);
  // Gives an event to the receiver.
  void tell(EventKind kind, std::uint64_t tick, std::string_view name, double value) const;

  std::size_t device_ = 0;
  RequestSlot requests_;
  StopSlot stops_;
  Ring<Command, kMaxWaiting> commands_;
  Ring<Answer, kMaxWaiting + kMaxRequests> answers_;
  // Command thread only: the number of commands whose answers have not been taken.
  std::size_t waiting_ = 0;
  // Loop only: the request of this tick.
  TicketedRequest pending_;
  // Loop only: the mode before the tick.
  Mode before_ = Mode::init;
  bool is_operated_ = false;
  Injector injector_;
  EventSink events_;
};

// Returns true if the mode `after` the tick is what the request asks for, and for Request::none.
bool took_effect(Request request, Mode after);

}  // namespace tactus::firmware
