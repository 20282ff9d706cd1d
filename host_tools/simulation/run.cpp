#include "host_tools/simulation/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <utility>

#include "host_tools/input_error.h"
#include "host_tools/simulation/named_device.h"
#include "host_tools/simulation/wish_path_file.h"
#include "rendering/limits.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {
namespace {

// The faults by their names in --fault.
constexpr std::array<std::pair<std::string_view, DeviceFault>, 4> kFaultNames = {{
    {"stale", DeviceFault::stale_sample},
    {"nan", DeviceFault::encoder_nan},
    {"estop", DeviceFault::emergency_stop},
    {"lost", DeviceFault::lost},
}};

// Returns the number that makes up the whole text, or nothing.
template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const char* const begin = text.data();  // NOLINT(bugprone-suspicious-stringview-data-usage)
  const char* const end = begin + text.size();
  const auto [stopped, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stopped != end) {
    return std::nullopt;
  }
  return value;
}

// Returns half the device's workspace along each axis, m.
Vec3 travel(const DevicePreset& device) {
  const PlantParameters& plant = device.device.plant;
  return 0.5 * (plant.stop_upper_B - plant.stop_lower_B);
}

// Returns the path of the user's file, else one made from the scene that suits the device.
WishPath choose_path(const RunOptions& options, std::size_t number, const DevicePreset& device,
                     std::span<const rendering::Object> objects, double tool_radius_m) {
  if (!options.paths.empty()) {
    return read_wish_path(options.paths[number]);
  }
  // How far the wish lies below the surface; the force on the hand follows from the hand's
  // stiffness.
  constexpr double kPress_m = 0.005;
  if (joints_of(device.device.plant.mechanism) == 1) {
    return sideways_wish_path(objects, tool_radius_m, kPress_m).repeated();
  }
  return default_wish_path(objects, tool_radius_m, kPress_m, 0.8 * travel(device).x()).repeated();
}

// Sets friction compensation as if the device's friction had been measured exactly. `share` is the
// compensated share, 0 to kMaxCompensatedShare; throws InputError outside.
void compensate_friction(double share, SimulationConfig& config) {
  const bool is_share = share >= 0.0 && share <= firmware::kMaxCompensatedShare;
  if (!is_share) {
    throw InputError(fmt::format("--compensate {}: write a share of the joints' friction, 0 to {}",
                                 share, firmware::kMaxCompensatedShare));
  }
  // Bristles turn within two counts of the encoder, the smallest motion that it can show.
  constexpr double kCounts = 2.0;
  config.controller.friction.fill(
      {.model = config.device.device.plant.joint_friction,
       .compensated_share = share,
       .turn_length = kCounts * config.device.device.encoder_resolution});
}

// The simulation moves the world's origin to the middle of the path. The walls of a device file's
// workspace stay where they are on the device; a wall that is nowhere stays nowhere.
void keep_walls_on_device(SimulationConfig& config) {
  const firmware::SafetyConfig without_walls;
  firmware::SafetyConfig& safety = config.controller.safety;
  const Vec3 moved_m =
      config.controller.workspace_origin_D - (config.device.centre_B - config.path.middle());
  for (int axis = 0; axis < 3; ++axis) {
    if (safety.workspace_lower_W[axis] > without_walls.workspace_lower_W[axis]) {
      safety.workspace_lower_W[axis] += moved_m[axis];
    }
    if (safety.workspace_upper_W[axis] < without_walls.workspace_upper_W[axis]) {
      safety.workspace_upper_W[axis] += moved_m[axis];
    }
  }
}

// Warns where the path is longer than the device's travel.
void warn_of_stops(const SimulationConfig& config, const std::string& device_name,
                   std::vector<std::string>& warnings) {
  const Vec3 reach_m = config.path.reach();
  const Vec3 travel_m = travel(config.device);
  for (int axis = 0; axis < 3; ++axis) {
    if (reach_m[axis] > travel_m[axis]) {
      warnings.push_back(
          fmt::format("the wish path spans {:.3f} m along {}, the {} device {:.3f} m: its stops "
                      "will hold the hand",
                      2.0 * reach_m[axis], "xyz"[axis], device_name, 2.0 * travel_m[axis]));
    }
  }
}

// Returns the entry of a device in a list with one for each device, or one for all.
const std::string& of_device(const std::vector<std::string>& list, std::size_t number) {
  return list.size() == 1 ? list.front() : list[number];
}

// Returns the configuration of a device.
SimulationConfig plan_device(const RunOptions& options, std::size_t number,
                             std::span<const rendering::Object> objects, double tool_radius_m) {
  const std::string& device_name = of_device(options.devices, number);
  const NamedDevice named = named_device(device_name, "--device");
  const std::string& hand_name = of_device(options.hands, number);
  const std::optional<HandParameters> hand = hand_preset(hand_name);
  if (!hand) {
    throw InputError(fmt::format("--hand {}: there are finger, pen and firm", hand_name));
  }
  SimulationConfig config{
      .device = named.device,
      .controller = named.controller,
      .hand = *hand,
      .path = choose_path(options, number, named.device, objects, tool_radius_m),
      // Hands tremble apart.
      .seed = options.seed + number,
      .rate_hz = options.rate_hz,
      .faults = {},
      .requests = {}};
  config.controller.allow_uncertified = options.allow_uncertified;
  config.controller.safety.moving_mass_kg = named.device.device.plant.moving_mass_kg;
  if (named.is_described()) {
    keep_walls_on_device(config);
  }
  compensate_friction(options.compensated_share, config);
  return config;
}

}  // namespace

std::size_t device_count(const RunOptions& options) {
  const std::size_t count = std::max(options.devices.size(), options.paths.size());
  const auto goes = [&](const std::vector<std::string>& list) {
    return list.size() == 1 || list.size() == count;
  };
  if (count > rendering::kMaxTools) {
    throw InputError(fmt::format("{} devices; there may be 1 to {}", count, rendering::kMaxTools));
  }
  if (!goes(options.devices) || !goes(options.hands)) {
    throw InputError(
        fmt::format("{} --device and {} --hand for {} --path: give one for each path, or one for "
                    "all",
                    options.devices.size(), options.hands.size(), options.paths.size()));
  }
  if (count > 1 && options.paths.size() != count) {
    throw InputError(fmt::format("{} devices and {} --path: several devices need a path each",
                                 count, options.paths.size()));
  }
  return count;
}

double described_rate_hz(const RunOptions& options) {
  const auto file = std::ranges::find_if(options.devices, names_file);
  return file == options.devices.end() ? options.rate_hz
                                       : named_device(*file, "--device").controller.rate_hz;
}

DeviceFaultEvent parse_fault(std::string_view text) {
  const std::size_t colon = text.find(':');
  const bool has_device = colon != std::string_view::npos;
  const std::optional<std::size_t> device =
      has_device ? number<std::size_t>(text.substr(0, colon)) : 1U;
  const std::string_view rest = has_device ? text.substr(colon + 1) : text;
  const std::size_t at = rest.find('@');
  for (const auto& [name, fault] : kFaultNames) {
    if (at == std::string_view::npos || rest.substr(0, at) != name) {
      continue;
    }
    const std::string_view when = rest.substr(at + 1);
    const std::size_t times = when.find('x');
    const std::optional<double> at_s = number<double>(when.substr(0, times));
    const std::optional<std::uint32_t> ticks =
        times == std::string_view::npos ? 1U : number<std::uint32_t>(when.substr(times + 1));
    if (device && *device > 0 && at_s && *at_s >= 0.0 && std::isfinite(*at_s) && ticks &&
        *ticks > 0) {
      return {.device = *device - 1, .event = {.at_s = *at_s, .fault = fault, .ticks = *ticks}};
    }
  }
  throw InputError(
      fmt::format("--fault {}: expected stale, nan, estop or lost, @ and its time in s, x and its "
                  "ticks, like stale@2.5x3, and before it the number of the device, like 2:lost@4",
                  text));
}

RunPlan plan_run(const RunOptions& options, std::span<const rendering::Object> objects,
                 double tool_radius_m) {
  RunPlan plan;
  const std::size_t count = device_count(options);
  plan.devices.reserve(count);
  double end_s = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const SimulationConfig& config =
        plan.devices.emplace_back(plan_device(options, i, objects, tool_radius_m));
    warn_of_stops(config, of_device(options.devices, i), plan.warnings);
    end_s = std::max(end_s, config.path.end_s());
  }
  for (const std::string& text : options.faults) {
    const auto& [device, event] = parse_fault(text);
    if (device >= count) {
      throw InputError(fmt::format("--fault {}: there are {} devices", text, count));
    }
    plan.devices[device].faults.push_back(event);
  }
  plan.seconds = options.seconds.value_or(end_s);
  if (!(plan.seconds > 0.0) || !std::isfinite(plan.seconds)) {
    throw InputError("--seconds must be positive");
  }
  return plan;
}

RunPlan plan_run(const RunOptions& options, const rendering::SceneImage& scene) {
  RunPlan plan = plan_run(options, scene.objects(), scene.tool_radius_m());
  for (SimulationConfig& config : plan.devices) {
    config.world = rendering::world_of(scene);
  }
  return plan;
}

std::vector<RunSummary> run(Simulation& simulation, double seconds, double rate_hz,
                            const TickSink& after, const TickSink& before) {
  using Clock = std::chrono::steady_clock;
  std::vector<RunSummary> summaries(simulation.device_count(), RunSummary{.rate_hz = rate_hz});
  // The small subtraction keeps a product such as 0.1 s * 1000 Hz, which is a little above 100,
  // from becoming one tick more.
  const auto ticks = static_cast<std::uint64_t>(std::ceil(seconds * rate_hz - 1e-6));
  const Clock::time_point start = Clock::now();
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    if (before) {
      before(simulation);
    }
    simulation.tick();
    for (std::size_t i = 0; i < summaries.size(); ++i) {
      summaries[i].add(simulation.record(i));
    }
    after(simulation);
  }
  const double wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  for (RunSummary& summary : summaries) {
    summary.wall_s = wall_s;
  }
  return summaries;
}

}  // namespace tactus::host
