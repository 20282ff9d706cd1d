// Takes the ticks from the loop and hands them, from a thread of its own, to whoever wants them: a
// recording, the readers of the live socket, PlotJuggler.
//
//   loop --RecordRing, EventRing--> thread --> MCAP or CSV file
//                                          --> live socket, for any number of readers
//                                          --> UDP on this machine
// The loop's part is a copy into a ring. Whatever happens to a disk or to a reader, it costs the
// loop nothing: what the thread is too slow for is dropped in the ring and counted there, and every
// tick tells how many were before it.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/realtime/helper_thread.h"
#include "firmware/telemetry/outputs/live_socket.h"
#include "firmware/telemetry/outputs/run_recorder.h"
#include "firmware/telemetry/outputs/udp_json.h"
#include "firmware/telemetry/ring.h"

namespace tactus::firmware {

class TelemetryWriter {
 public:
  TelemetryWriter() = default;
  TelemetryWriter(const TelemetryWriter&) = delete;
  TelemetryWriter& operator=(const TelemetryWriter&) = delete;
  ~TelemetryWriter() { stop(); }

  // Before `start`, each; 0, or errno.
  void describe(const RunDescription& run);
  int open_live_socket(const char* path) { return live_.open(path); }
  // One tick of so many goes out.
  int open_udp(std::uint16_t port, std::uint32_t every);
  int start();

  // Real time, from the loop's thread: wait-free.
  void publish(RecordedTick& tick) {
    tick.dropped = ticks_.dropped();
    ticks_.push(tick);
  }
  void publish(const TelemetryEvent& event) { events_.push(event); }

  // From one other thread, before `start` or after, while nobody else calls these; waits for the
  // writer's thread, which is as long as the file takes. `path`, names and bytes stay where they
  // are: `path` for the call, the others for good.
  int record(const char* path, IfThere if_there = IfThere::replace);  // 0, or errno
  int end_recording();  // 0, or the errno that had ended it early
  bool attach(const Attachment& attachment);

  // After the loop's last tick: writes what is left, closes everything. What end_recording says.
  int stop();

  // Any thread.
  [[nodiscard]] std::uint64_t dropped_ticks() const { return ticks_.dropped(); }
  [[nodiscard]] std::uint64_t dropped_events() const { return events_.dropped(); }
  // 0, or the errno that ended the recording.
  [[nodiscard]] int recording_error() const { return error_.load(std::memory_order_relaxed); }
  // The thread's own; after `stop`.
  [[nodiscard]] const LiveCounts& live_counts() const { return live_.counts(); }

 private:
  enum class Order : std::uint8_t { none, record, end, attach };

  int carry_out(Order order);
  int obey(Order order);
  void run();
  void cycle();
  void hand_on_events();
  void hand_on_ticks();
  void flush_at_times(hal::TimeNs now_ns);

  RecordRing ticks_;
  EventRing events_;
  HelperThread thread_;
  bool started_ = false;
  std::atomic<bool> stopping_{false};

  // Another thread's order to this one; `path_` and `attachment_` belong to who has it.
  std::atomic<Order> order_{Order::none};
  const char* path_ = nullptr;
  IfThere if_there_ = IfThere::replace;
  Attachment attachment_;
  int answer_ = 0;

  // The thread's own.
  std::span<const MetadataEntry> run_info_;
  RecordEncoder encoder_;
  RunRecorder recorder_;
  LiveSocket live_;
  UdpJson udp_;
  std::uint32_t udp_every_ = 1;
  hal::TimeNs flushed_ns_ = 0;
  std::atomic<int> error_{0};
};

}  // namespace tactus::firmware
