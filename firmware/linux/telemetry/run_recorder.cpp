#include "firmware/linux/telemetry/run_recorder.h"

#include <string_view>

namespace tactus::firmware {

bool RunRecorder::attach(const Attachment& attachment) {
  const bool known = attachments_.set(attachment);
  if (known && mcap_.is_open()) {
    mcap_.attach(attachment);
  }
  return known;
}

int RunRecorder::open(const char* path, IfThere if_there) {
  close();
  if (std::string_view(path).ends_with(".csv")) {
    csv_.open(path, run_.joints, if_there);
  } else if (mcap_.open(path, run_.clock_offset_ns, run_.info, if_there) == 0) {
    for (const Attachment& attachment : attachments_.all()) {
      mcap_.attach(attachment);
    }
  }
  const int failed = csv_.is_open() ? csv_.error() : mcap_.error();
  if (failed != 0) {
    close();
  }
  return failed;
}

void RunRecorder::add(const RecordedTick& tick, std::span<const std::byte> message) {
  if (mcap_.is_open()) {
    mcap_.add(tick, message);
  }
  if (csv_.is_open()) {
    csv_.add(tick);
  }
}

void RunRecorder::add(const TelemetryEvent& event, std::span<const std::byte> message) {
  if (mcap_.is_open()) {
    mcap_.add(event, message);
  }
}

void RunRecorder::add(const Explanation& explanation, std::span<const std::byte> message) {
  if (mcap_.is_open()) {
    mcap_.add(explanation, message);
  }
}

void RunRecorder::flush() {
  if (mcap_.is_open()) {
    mcap_.flush();
  }
  if (csv_.is_open()) {
    csv_.flush();
  }
}

int RunRecorder::close() {
  const int mcap = mcap_.close();
  const int csv = csv_.close();
  return mcap != 0 ? mcap : csv;
}

}  // namespace tactus::firmware
