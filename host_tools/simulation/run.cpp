#include "host_tools/simulation/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <utility>

#include "host_tools/input_error.h"
#include "host_tools/simulation/wish_path_file.h"

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
WishPath choose_path(const RunOptions& options, const DevicePreset& device,
                     std::span<const rendering::Object> objects, double tool_radius_m) {
  if (!options.path.empty()) {
    return read_wish_path(options.path);
  }
  // How far the wish lies below the surface; the force on the hand follows from the hand's
  // stiffness.
  constexpr double kPress_m = 0.005;
  if (joints_of(device.device.plant.mechanism) == 1) {
    return sideways_wish_path(objects, tool_radius_m, kPress_m);
  }
  return default_wish_path(objects, tool_radius_m, kPress_m, 0.8 * travel(device).x());
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

// Warns where the path is longer than the device's travel.
void warn_of_stops(RunPlan& plan, const std::string& device_name) {
  const Vec3 reach_m = plan.config.path.reach();
  const Vec3 travel_m = travel(plan.config.device);
  for (int axis = 0; axis < 3; ++axis) {
    if (reach_m[axis] > travel_m[axis]) {
      plan.warnings.push_back(
          fmt::format("the wish path spans {:.3f} m along {}, the {} device {:.3f} m: its stops "
                      "will hold the hand",
                      2.0 * reach_m[axis], "xyz"[axis], device_name, 2.0 * travel_m[axis]));
    }
  }
}

}  // namespace

FaultEvent parse_fault(std::string_view text) {
  const std::size_t at = text.find('@');
  for (const auto& [name, fault] : kFaultNames) {
    if (at == std::string_view::npos || text.substr(0, at) != name) {
      continue;
    }
    const std::string_view when = text.substr(at + 1);
    const std::size_t times = when.find('x');
    const std::optional<double> at_s = number<double>(when.substr(0, times));
    const std::optional<std::uint32_t> ticks =
        times == std::string_view::npos ? 1U : number<std::uint32_t>(when.substr(times + 1));
    if (at_s && *at_s >= 0.0 && std::isfinite(*at_s) && ticks && *ticks > 0) {
      return {.at_s = *at_s, .fault = fault, .ticks = *ticks};
    }
  }
  throw InputError(
      fmt::format("--fault {}: expected stale, nan, estop or lost, @ and its time in s, and x and "
                  "its ticks, like stale@2.5x3",
                  text));
}

RunPlan plan_run(const RunOptions& options, std::span<const rendering::Object> objects,
                 double tool_radius_m) {
  const std::optional<DevicePreset> device = device_preset(options.device);
  const std::optional<firmware::ControllerConfig> controller =
      firmware::preset_config(options.device);
  if (!device || !controller) {
    throw InputError(fmt::format("--device {}: there are {}", options.device,
                                 fmt::join(firmware::kPresetNames, ", ")));
  }
  const std::optional<HandParameters> hand = hand_preset(options.hand);
  if (!hand) {
    throw InputError(fmt::format("--hand {}: there are finger, pen and firm", options.hand));
  }
  RunPlan plan{.config = {.device = *device,
                          .controller = *controller,
                          .hand = *hand,
                          .path = choose_path(options, *device, objects, tool_radius_m),
                          .seed = options.seed,
                          .rate_hz = options.rate_hz,
                          .faults = {},
                          .requests = {}},
               .warnings = {}};
  plan.config.controller.safety.moving_mass_kg = device->device.plant.moving_mass_kg;
  compensate_friction(options.compensated_share, plan.config);
  for (const std::string& fault : options.faults) {
    plan.config.faults.push_back(parse_fault(fault));
  }
  plan.seconds = options.seconds.value_or(plan.config.path.end_s());
  if (!(plan.seconds > 0.0) || !std::isfinite(plan.seconds)) {
    throw InputError("--seconds must be positive");
  }
  warn_of_stops(plan, options.device);
  return plan;
}

RunSummary run(Simulation& simulation, double seconds, double rate_hz, const TickSink& sink) {
  using Clock = std::chrono::steady_clock;
  RunSummary summary;
  summary.rate_hz = rate_hz;
  // The small subtraction keeps a product such as 0.1 s * 1000 Hz, which is a little above 100,
  // from becoming one tick more.
  const auto ticks = static_cast<std::uint64_t>(std::ceil(seconds * rate_hz - 1e-6));
  const Clock::time_point start = Clock::now();
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    simulation.tick();
    summary.add(simulation.record());
    sink(simulation);
  }
  summary.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  return summary;
}

}  // namespace tactus::host
