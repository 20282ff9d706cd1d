#include "host_tools/replay/replay.h"

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/linux/flight/attachments.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the words for missing ticks, from `from` up to but not with `to`.
std::string gap(std::uint64_t from, std::uint64_t to) {
  return "ticks " + std::to_string(from) + " to " + std::to_string(to - 1) +
         " are missing in the recording, and nothing can be replayed beyond them";
}

// Returns a number that a recording says about its run, or 1.
std::size_t info_number(RecordedRun& run, std::string_view key) {
  const std::string text(run.ticks().info(key));
  return text.empty() ? 1 : std::strtoul(text.c_str(), nullptr, 10);
}

// Throws InputError unless the recordings are those of all devices of a run, in their order.
void check_devices(std::span<RecordedRun* const> devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const std::size_t number = info_number(*devices[i], firmware::kDeviceNumberKey);
    const std::size_t count = info_number(*devices[i], firmware::kDeviceCountKey);
    if (number != i + 1 || count != devices.size()) {
      throw InputError(devices[i]->name() + ": it is of device " + std::to_string(number) + " of " +
                       std::to_string(count) + ", and is given as " + std::to_string(i + 1) +
                       " of " + std::to_string(devices.size()) +
                       "; give the recordings of all devices of the run, in their order");
    }
  }
}

// Reads the same tick of every recording into `records`. Returns the first one's, or nothing at the
// end. Throws InputError if another recording does not have it.
std::optional<firmware::RecordedTick> next_tick(std::span<RecordedRun* const> devices,
                                                std::vector<firmware::TelemetryRecord>& records) {
  auto first = devices.front()->ticks().next();
  for (std::size_t i = 0; first && i < devices.size(); ++i) {
    const auto tick = i == 0 ? first : devices[i]->ticks().next();
    if (!tick || tick->record.tick != first->record.tick) {
      throw InputError(devices[i]->name() + ": tick " + std::to_string(first->record.tick) +
                       " of the first device's recording is missing in it");
    }
    records[i] = tick->record;
  }
  return first;
}

}  // namespace

ReplayResult replay(RecordedRun& run, const ReplaySink& sink, const ReplayStart& start) {
  const std::array<RecordedRun*, 1> devices{&run};
  return replay(devices, sink, start);
}

ReplayResult replay(std::span<RecordedRun* const> devices, const ReplaySink& sink,
                    const ReplayStart& start) {
  check_devices(devices);
  RecordedRun& run = *devices.front();
  std::vector<ReplaySetup> setups;
  setups.reserve(devices.size());
  for (const RecordedRun* const device : devices) {
    setups.push_back(device->setup());
  }
  Replayer replayer(setups);
  ReplayResult result{.cut = run.ticks().cut()};
  if (!run.state().empty()) {
    replayer.go_to(run.state());
    result.first_tick = replayer.next_tick();
  }
  for (RecordedRun* const device : devices) {
    device->ticks().rewind();
  }
  if (start) {
    start(replayer.controller());
  }
  std::vector<firmware::TelemetryRecord> records(devices.size());
  while (const auto recorded = next_tick(devices, records)) {
    const std::uint64_t tick = recorded->record.tick;
    if (tick < result.first_tick) {
      continue;
    }
    const std::uint64_t expected = result.first_tick + result.ticks;
    if (tick != expected) {
      throw InputError(tick < expected ? "the run starts over at tick " + std::to_string(tick)
                                       : gap(expected, tick));
    }
    if (const rendering::SceneImage* const scene = run.changed_scene(tick)) {
      replayer.use_scene(*scene);
    }
    result.difference = replayer.repeat(records);
    if (result.difference) {
      return result;
    }
    ++result.ticks;
    if (sink) {
      sink(*recorded);
    }
  }
  return result;
}

}  // namespace tactus::host
