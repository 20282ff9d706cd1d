#include "host_tools/replay/replay.h"

#include <string>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the words for missing ticks, from `from` up to but not with `to`.
std::string gap(std::uint64_t from, std::uint64_t to) {
  return "ticks " + std::to_string(from) + " to " + std::to_string(to - 1) +
         " are missing in the recording, and nothing can be replayed beyond them";
}

}  // namespace

ReplayResult replay(RecordedRun& run, const ReplaySink& sink, const ReplayStart& start) {
  Replayer replayer(run.setup());
  ReplayResult result{.cut = run.ticks().cut()};
  if (!run.state().empty()) {
    replayer.go_to(run.state());
    result.first_tick = replayer.next_tick();
  }
  run.ticks().rewind();
  if (start) {
    start(replayer.controller());
  }
  while (const auto recorded = run.ticks().next()) {
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
    result.difference = replayer.repeat(recorded->record);
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
