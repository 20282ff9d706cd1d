// The outputs of telemetry: the recording, the readers of the live socket, and PlotJuggler. One
// thread at a time, except where a function says more; not real time.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "firmware/linux/telemetry/live_socket.h"
#include "firmware/linux/telemetry/order_slot.h"
#include "firmware/linux/telemetry/record_encoder.h"
#include "firmware/linux/telemetry/run_recorder.h"
#include "firmware/linux/telemetry/udp_json.h"
#include "hal/clock.h"

namespace tactus::firmware {

// The outputs of one run.
class TelemetryOutputs {
 public:
  // Sets the description of the run. Call before the first recording.
  void describe(const RunDescription& run);
  // Opens the live socket (live_socket.h). Returns 0 or errno.
  int open_live_socket(const char* path) { return live_.open(path); }
  // Sends ticks of a loop of that rate as JSON to a port of this machine, kUdpRate_Hz of them a
  // second. Returns 0 or errno.
  int open_udp(std::uint16_t port, double rate_hz);

  // Carries out an order. Returns 0 or errno; for the end of a recording, the errno that had ended
  // it early.
  int carry_out(const TelemetryOrder& order);

  // Accepts new readers of the live socket and hears what they ask for.
  void accept_readers(hal::TimeNs now_ns);
  // Pass a tick or an event on to all outputs.
  void add(const TelemetryEvent& event);
  void add(const RecordedTick& tick);
  // Passes an explanation on to the recording and to the readers that want it.
  void add(const Explanation& explanation);
  // Passes places on to the readers that want them.
  void add(const ObjectPlaces& places);
  // Sends what the readers have not got yet, writes the file's buffer once in a while, and ends a
  // recording that has failed.
  void flush(hal::TimeNs now_ns);

  // Ends the recording and closes the live socket.
  void close();

  // Return true while a reader wants explanations, or places. Any thread.
  [[nodiscard]] bool wants_explanations() const {
    return is_explaining_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] bool wants_places() const { return is_placing_.load(std::memory_order_relaxed); }
  // Returns 0 or the errno that ended the recording. Any thread.
  [[nodiscard]] int recording_error() const { return error_.load(std::memory_order_relaxed); }

 private:
  std::span<const MetadataEntry> run_info_;
  RecordEncoder encoder_;
  RunRecorder recorder_;
  LiveSocket live_;
  UdpJson udp_;
  std::uint32_t udp_every_ = 1;
  // The time at which the file's buffer was written last.
  hal::TimeNs flushed_ns_ = 0;
  std::atomic<int> error_{0};
  std::atomic<bool> is_explaining_{false};
  std::atomic<bool> is_placing_{false};
};

}  // namespace tactus::firmware
