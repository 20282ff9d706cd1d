// Takes the ticks from the loop and, in its own thread, passes them to a recording, to the readers
// of the live socket and to PlotJuggler.
//
//   loop --RecordRing, EventRing, ExplanationRing, PlacesRing--> thread --> MCAP or CSV file
//                                                                       --> live socket, for up
//                                                                           to 8 readers
//                                                                       --> UDP on this machine
// The loop only copies each tick into a ring, so a slow disk or reader costs the loop nothing. If
// the thread is too slow, ticks are dropped and counted; every tick holds the number dropped before
// it.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/linux/realtime/helper_thread.h"
#include "firmware/linux/telemetry/order_slot.h"
#include "firmware/linux/telemetry/run_recorder.h"
#include "firmware/linux/telemetry/telemetry_outputs.h"
#include "firmware/telemetry/ring.h"

namespace tactus::firmware {

// The writer of one run. Each function says which thread may call it.
class TelemetryWriter {
 public:
  TelemetryWriter() = default;
  TelemetryWriter(const TelemetryWriter&) = delete;
  TelemetryWriter& operator=(const TelemetryWriter&) = delete;
  ~TelemetryWriter() { stop(); }

  // Sets the description of the run. Call this, open_live_socket and open_udp before `start`.
  void describe(const RunDescription& run) { outputs_.describe(run); }
  // Opens the live socket (live_socket.h). Returns 0 or errno.
  int open_live_socket(const char* path) { return outputs_.open_live_socket(path); }
  // Sends ticks of a loop of that rate as JSON to a port of this machine. Returns 0 or errno.
  int open_udp(std::uint16_t port, double rate_hz) { return outputs_.open_udp(port, rate_hz); }
  // Starts the thread. Returns 0 or errno.
  int start();

  // Publish a tick or an event. Call from the loop's thread; real time, wait-free.
  void publish(RecordedTick& tick) {
    tick.dropped = ticks_.dropped();
    ticks_.push(tick);
  }
  // Publishes a tick that came from afar, with the number of ticks that were dropped on its path.
  void publish_relayed(RecordedTick& tick) {
    tick.dropped += ticks_.dropped();
    ticks_.push(tick);
  }
  void publish(const TelemetryEvent& event) { events_.push(event); }
  // Publishes an explanation of the same tick, before or after it. Like a tick it is dropped if the
  // thread is too slow, but not counted: its readers see a gap in the numbers.
  void publish(const Explanation& explanation) { explanations_.push(explanation); }
  // Publishes the places of the objects that move, for the live socket alone; dropped likewise.
  void publish(const ObjectPlaces& places) { places_.push(places); }
  // Return true while a reader of the live socket wants explanations, or places. Any thread;
  // wait-free.
  [[nodiscard]] bool wants_explanations() const { return outputs_.wants_explanations(); }
  [[nodiscard]] bool wants_places() const { return outputs_.wants_places(); }

  // Starts a recording, after ending the present one. Returns 0 or errno. This function and the
  // next two are for one other thread at a time, before or after `start`. They wait for the
  // writer's thread, as long as the file system takes.
  int record(const char* path, IfThere if_there = IfThere::replace);
  // Ends the recording. Returns 0 or the errno that had ended it early.
  int end_recording();
  // Adds an attachment to recordings. Its name and bytes must stay valid. Returns false if there is
  // no room.
  bool attach(const Attachment& attachment);

  // Writes the remaining ticks and closes all outputs. Call after the loop's last tick. Returns the
  // same as end_recording.
  int stop();

  // Returns the number of ticks dropped so far. Any thread.
  [[nodiscard]] std::uint64_t dropped_ticks() const { return ticks_.dropped(); }
  // Returns 0 or the errno that ended the recording. Any thread.
  [[nodiscard]] int recording_error() const { return outputs_.recording_error(); }

 private:
  // Lets the thread that owns the outputs carry out an order, and returns the answer.
  int obey(const TelemetryOrder& order);
  // The thread's body.
  void run();
  // One round: accepts readers, passes events and ticks on, sends, and takes an order.
  void cycle();

  RecordRing ticks_;
  EventRing events_;
  ExplanationRing explanations_;
  PlacesRing places_;
  HelperThread thread_;
  bool started_ = false;
  std::atomic<bool> stopping_{false};
  OrderSlot orders_;
  // They belong to the writer's thread between start() and stop().
  TelemetryOutputs outputs_;
};

}  // namespace tactus::firmware
