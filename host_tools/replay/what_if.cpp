#include "host_tools/replay/what_if.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "firmware/control/parameter_choices.h"
#include "firmware/control/parameter_name.h"
#include "host_tools/input_error.h"
#include "host_tools/replay/replayer.h"

namespace tactus::host {
namespace {

using firmware::ParameterChange;

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
  throw InputError("--set " + std::string(text) + ": " + std::string(why));
}

// Returns the number of an object that the user gave by number or by name. Throws InputError.
std::uint32_t find_object(std::string_view text, std::string_view name,
                          const rendering::SceneImage* scene) {
  if (const auto number = firmware::object_number(name)) {
    return *number;
  }
  for (std::uint32_t i = 0; scene != nullptr && i < scene->objects().size(); ++i) {
    if (scene->object_name(i) == name) {
      return i;
    }
  }
  refuse(text, "the scene has no object of this name");
}

Vec3 to_vector(const firmware::Triple& triple) {
  return {triple[0], triple[1], triple[2]};
}

// Changes a parameter. Throws InputError with the reason and, where it is known, the range.
void apply(firmware::Controller& controller, const ParameterChange& change) {
  const auto done = controller.set_parameter(change);
  if (done) {
    return;
  }
  std::string why(firmware::describe(done.error()));
  const auto range = controller.parameter(change.place);
  if (range && has_choices(change.place.parameter)) {
    std::string names;
    firmware::for_each_choice(change.place.parameter, *range, [&](std::string_view name) {
      names += (names.empty() ? "" : ", ") + std::string(name);
    });
    why += "; write one of " + names;
  } else if (range) {
    why += "; from " + std::to_string(range->least) + " to " + std::to_string(range->greatest);
  }
  refuse(firmware::text_of(change.place.parameter)->name, why);
}

// Sums for the means: forces in N over the ticks in which either force was felt.
struct HandForces {
  double recorded_N = 0.0;
  double changed_N = 0.0;
  std::uint64_t ticks = 0;
};

// Takes a tick into the largest forces, and into the means if one of the two pushes.
void add(const WhatIfTick& tick, WhatIfSummary& summary, HandForces& forces) {
  const double recorded_N = tick.recorded_W.norm();
  const double changed_N = tick.changed_W.norm();
  const double apart_N = (tick.changed_W - tick.recorded_W).norm();
  ++summary.ticks;
  summary.most_recorded_N = std::max(summary.most_recorded_N, recorded_N);
  summary.most_changed_N = std::max(summary.most_changed_N, changed_N);
  if (apart_N > summary.most_apart_N) {
    summary.most_apart_N = apart_N;
    summary.most_apart_s = tick.time_s;
  }
  if (recorded_N > 0.0 || changed_N > 0.0) {
    forces.recorded_N += recorded_N;
    forces.changed_N += changed_N;
    ++forces.ticks;
  }
}

}  // namespace

ParameterChange parse_change(std::string_view text, const rendering::SceneImage* scene) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    refuse(text, "write it as name=value, like max_force_N=4");
  }
  const auto name = firmware::parse_parameter_name(text.substr(0, equals));
  if (!name) {
    refuse(text, "there is no such parameter; tactus get lists them");
  }
  ParameterChange change{.place = {.parameter = name->parameter}};
  if (firmware::is_of_object(name->parameter)) {
    change.place.object = find_object(text, name->object, scene);
  }
  const std::string_view value = text.substr(equals + 1);
  if (firmware::has_choices(name->parameter)) {
    change.value = firmware::choice_of(name->parameter, value);
    return change;
  }
  const auto [end, error] =
      std::from_chars(value.data(), value.data() + value.size(), change.value);
  if (error != std::errc{} || end != value.data() + value.size() || !std::isfinite(change.value)) {
    refuse(text, "the value is no number");
  }
  return change;
}

WhatIfSummary what_if(RecordedRun& run, std::span<const ParameterChange> changes,
                      const WhatIfSink& sink) {
  Replayer replayer(run.setup());
  if (!run.state().empty()) {
    replayer.go_to(run.state());
  }
  for (const ParameterChange& change : changes) {
    apply(replayer.controller(), change);
  }
  const auto is_set = [&](const firmware::ParameterPlace& place) {
    return std::ranges::any_of(
        changes, [&](const ParameterChange& change) { return change.place == place; });
  };
  WhatIfSummary summary;
  HandForces forces;
  run.ticks().rewind();
  while (auto recorded = run.ticks().next()) {
    firmware::TelemetryRecord& record = recorded->record;
    if (record.tick < replayer.next_tick()) {
      continue;
    }
    if (run.changed_scene(record.tick) != nullptr) {
      summary.scene_changed_s = record.time_s;
      break;
    }
    // The run's own change would undo what the user asks for.
    if (is_set(record.change.place)) {
      record.change = {};
    }
    replayer.repeat(record);
    const WhatIfTick tick{.time_s = record.time_s,
                          .recorded_W = to_vector(record.force_commanded_W),
                          .changed_W = to_vector(replayer.record().force_commanded_W)};
    add(tick, summary, forces);
    const bool faulted = replayer.record().mode == firmware::Mode::fault;
    if (faulted && record.mode != firmware::Mode::fault && !summary.fault_s) {
      summary.fault_s = record.time_s;
    }
    sink(tick);
  }
  const double ticks = std::max<double>(1.0, static_cast<double>(forces.ticks));
  summary.mean_recorded_N = forces.recorded_N / ticks;
  summary.mean_changed_N = forces.changed_N / ticks;
  return summary;
}

}  // namespace tactus::host
