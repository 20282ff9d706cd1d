// Writes the same random ticks as an MCAP recording and as a CSV file, for check_recording.js:
//   write_recording RUN.mcap RUN.csv [SEED]
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>

#include "firmware/linux/telemetry/run_recorder.h"
#include "tests/unit/firmware/linux/telemetry/random_tick.h"

namespace {

using tactus::firmware::kModeNames;
using tactus::firmware::kRequestNames;
using tactus::firmware::MetadataEntry;
using tactus::firmware::Mode;
using tactus::firmware::random_tick;
using tactus::firmware::RecordedTick;
using tactus::firmware::RecordEncoder;
using tactus::firmware::Request;
using tactus::firmware::RunRecorder;
using tactus::firmware::TelemetryEvent;

constexpr std::uint64_t kTicks = 1500;
constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr std::int64_t kClockOffset_ns = 1'700'000'000'000'000'000;
constexpr std::array<MetadataEntry, 1> kInfo{{{"rate_hz", "1000"}}};
constexpr std::array<char, 5> kImage{'i', 'm', 'a', 'g', 'e'};

RecordedTick valid_tick(std::mt19937_64& random, std::uint64_t number) {
  RecordedTick tick = random_tick(random);
  tick.record.tick = number;
  tick.record.mode = static_cast<Mode>(number % kModeNames.size());
  tick.record.request = static_cast<Request>(number % kRequestNames.size());
  tick.loop.scheduled_ns = static_cast<std::int64_t>(number) * kPeriod_ns;
  return tick;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: write_recording RUN.mcap RUN.csv [SEED]\n", stderr);
    return 2;
  }
  const unsigned seed =
      argc > 3 ? static_cast<unsigned>(std::strtoul(argv[3], nullptr, 10)) : std::random_device{}();
  std::printf("seed %u\n", seed);
  std::mt19937_64 random(seed);
  RecordEncoder encoder;
  const auto mcap = std::make_unique<RunRecorder>();
  const auto csv = std::make_unique<RunRecorder>();
  for (RunRecorder* recorder : {mcap.get(), csv.get()}) {
    recorder->describe(
        {.info = kInfo, .joints = tactus::drivers::kMaxJoints, .clock_offset_ns = kClockOffset_ns});
    recorder->attach({.name = "device.tactus", .bytes = std::as_bytes(std::span(kImage))});
  }
  if (mcap->open(argv[1]) != 0 || csv->open(argv[2]) != 0) {
    return 1;
  }
  for (std::uint64_t i = 0; i < kTicks; ++i) {
    const RecordedTick tick = valid_tick(random, i);
    if (i % 100 == 50) {
      TelemetryEvent event{.tick = i, .time_ns = tick.loop.scheduled_ns};
      set_name(event, "note");
      mcap->add(event, encoder.encode(event));
    }
    const auto message = encoder.encode(tick);
    mcap->add(tick, message);
    csv->add(tick, message);
  }
  return mcap->close() != 0 || csv->close() != 0 ? 1 : 0;
}
