// Where commands wait for the tick, and answers for the one who asked.
//
// One thread posts and takes answers, the loop calls before_tick and after_tick. No locks, no heap,
// and neither side ever waits for the other. Requests go through a slot where the newest wins and
// an estop stays; everything else keeps its order, one a tick.
//
// A stop has a way of its own, which any thread may take.
//
// Nothing is lost as long as the one thread takes the answers often: at most kMaxRequests between
// two times that it has taken them all.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/commands/command.h"
#include "firmware/commands/injection.h"
#include "firmware/commands/request_slot.h"
#include "firmware/control/controller.h"
#include "firmware/telemetry/ring.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::firmware {

// Commands whose answers have not been taken yet, at most.
inline constexpr std::size_t kMaxWaiting = 16;
// And requests.
inline constexpr std::size_t kMaxRequests = 48;

// Called from the loop: bounded, without locks. Null tells nobody.
struct EventSink {
  void* to = nullptr;
  void (*tell)(void* to, const TelemetryEvent& event) = nullptr;
};

// The tick that had a stop.
struct StopTaken {
  std::uint64_t tick = 0;
  Mode after = Mode::init;
};

class CommandDesk {
 public:
  // Any thread's side, beside the command thread's.

  // An estop for the next tick, whatever else waits for it. The stop's number.
  std::uint32_t post_stop() { return stops_posted_.fetch_add(1, std::memory_order_acq_rel) + 1; }

  // The tick that had the stop of that number, or nothing yet.
  [[nodiscard]] std::optional<StopTaken> stop_taken(std::uint32_t stop) const;

  // The command thread's side.

  // Whether there is room for one more command; a request needs none.
  [[nodiscard]] bool has_room() const { return waiting_ < kMaxWaiting; }

  // Only while there is room, unless it is a request. An answer that is known at once: of a request
  // that the newest has replaced, or that an estop keeps out.
  std::optional<Answer> post(const Command& command);

  // The next answer of a tick, if there is one.
  std::optional<Answer> next_answer();

  // The loop's side.

  // Before a tick: carries out what has to be done at its edge. The request for the tick, or none.
  Request before_tick(Controller& controller);

  // After it: answers the request.
  void after_tick(const Controller& controller);

  // True from the first request on: what starts by itself then leaves it to the operator.
  [[nodiscard]] bool is_operated() const { return is_operated_; }

  // Between the device and the controller; does nothing until somebody injects.
  [[nodiscard]] Injector& injector() { return injector_; }

  // Where the loop tells of what took effect; set before the start.
  void set_events(const EventSink& events) { events_ = events; }

 private:
  void answer_stop(const TelemetryRecord& record);
  void carry_out(const Command& command, Controller& controller);
  void set(const Command& command, Controller& controller, Answer& answer);
  void set_scene(const Command& command, Controller& controller, Answer& answer);
  void tell(EventKind kind, std::uint64_t tick, std::string_view name, double value) const;

  RequestSlot requests_;
  Ring<Command, kMaxWaiting> commands_;
  Ring<Answer, kMaxWaiting + kMaxRequests> answers_;
  std::size_t waiting_ = 0;  // commands whose answers have not been taken; the command thread's
  TicketedRequest pending_;  // the loop's, from before_tick to after_tick
  std::atomic<std::uint32_t> stops_posted_{0};
  std::uint32_t stops_seen_ = 0;                  // the loop's
  std::atomic<std::uint32_t> stops_answered_{0};  // up to this number; the two below are of it
  std::atomic<std::uint64_t> stop_tick_{0};
  std::atomic<Mode> stop_mode_{Mode::init};
  Mode before_ = Mode::init;
  bool is_operated_ = false;
  Injector injector_;
  EventSink events_;
};

// Whether a request has done in its tick what it asks for, or there was nothing to do.
bool took_effect(Request request, Mode after);

}  // namespace tactus::firmware
