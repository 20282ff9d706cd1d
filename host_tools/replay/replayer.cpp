#include "host_tools/replay/replayer.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "firmware/control/repeat_tick.h"
#include "firmware/telemetry/record_fields.h"
#include "host_tools/configure_controller.h"
#include "host_tools/input_error.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {
namespace {

// Returns the shortest text that reads back to the same bits, as std::to_chars without a precision
// gives it.
template <class Number>
  requires std::is_arithmetic_v<Number>
std::string in_digits(Number value) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

// An enumeration's value as a number.
template <class Value>
std::string in_digits(Value value)
  requires std::is_enum_v<Value>
{
  return in_digits(static_cast<unsigned>(value));
}

// Compares bits, so that 0.0 and -0.0 differ; every NaN equals every other, as in the state hash.
template <class Value>
bool same_bits(const Value& a, const Value& b) {
  if constexpr (std::floating_point<Value>) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
  } else {
    return a == b;
  }
}

// Returns ".x", ".y" or ".z" for an array of three, else for example "[2]".
std::string element_name(std::size_t index, std::size_t count) {
  constexpr std::string_view kAxes = "xyz";
  return count == 3 ? std::string(".") + kAxes[index] : "[" + std::to_string(index) + "]";
}

// A visitor for visit_record_fields(): it compares each field of one record with the same field of
// the other, and keeps the first difference. The state hash is kept apart, since it follows from
// the rest.
struct FieldComparison {
  const firmware::TelemetryRecord& recorded;
  const firmware::TelemetryRecord& replayed;
  std::optional<Difference> first;
  std::optional<Difference> hash;

  template <class Value>
  void operator()(const firmware::FieldName& name, const Value& here) {
    // The visitor gets a field of one record only. Both records have the same type, so the same
    // offset leads to the same field of the other.
    const auto offset =
        reinterpret_cast<const std::byte*>(&here) - reinterpret_cast<const std::byte*>(&recorded);
    const void* const place = reinterpret_cast<const std::byte*>(&replayed) + offset;
    const auto& there = *static_cast<const Value*>(place);
    if (!first && !name.name.starts_with("stage_ns")) {
      compare(std::string(name.name), here, there);
    }
  }

  template <class Value>
  void compare(const std::string& name, const Value& here, const Value& there) {
    if (same_bits(here, there)) {
      return;
    }
    (name == "state_hash" ? hash : first) = Difference{.tick = recorded.tick,
                                                       .field = name,
                                                       .recorded = in_digits(here),
                                                       .replayed = in_digits(there)};
  }

  template <class Value, std::size_t kSize>
  void compare(const std::string& name, const std::array<Value, kSize>& here,
               const std::array<Value, kSize>& there) {
    for (std::size_t i = 0; i < kSize && !first; ++i) {
      compare(name + element_name(i, kSize), here[i], there[i]);
    }
  }
};

}  // namespace

std::optional<Difference> first_difference(const firmware::TelemetryRecord& recorded,
                                           const firmware::TelemetryRecord& replayed) {
  FieldComparison comparison{.recorded = recorded, .replayed = replayed};
  firmware::visit_record_fields(recorded, comparison);
  return comparison.first ? comparison.first : comparison.hash;
}

Replayer::Replayer(std::span<const ReplaySetup> devices) : controller_(devices.size()) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    firmware::ControllerConfig config = devices[i].config;
    // The run was allowed to load its scene; the replay must be too.
    config.allow_uncertified = true;
    configure(*controller_, config, i);
  }
  const ReplaySetup& first = devices.front();
  if (!first.objects.empty() && !controller_->load_scene(first.objects, first.world)) {
    throw InputError("the controller refuses the scene");
  }
}

void Replayer::use_scene(const rendering::SceneImage& scene) {
  if (!controller_->load_scene(scene.objects(), rendering::world_of(scene))) {
    throw InputError("the controller refuses the scene that the run changed to before tick " +
                     std::to_string(next_tick()));
  }
}

void Replayer::go_to(std::span<const std::byte> state) {
  if (!controller_->restore(state)) {
    throw InputError(
        "the state that the recording begins with does not fit its configuration and scene, or is "
        "of another version");
  }
}

std::optional<Difference> Replayer::repeat(std::span<const firmware::TelemetryRecord> recorded) {
  firmware::repeat_tick(*controller_, recorded);
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const firmware::TelemetryRecord& replayed = controller_->record(i);
    if (replayed.state_hash == recorded[i].state_hash) {
      continue;
    }
    std::optional<Difference> difference = first_difference(recorded[i], replayed);
    if (difference) {
      difference->device = i;
    }
    return difference;
  }
  return std::nullopt;
}

}  // namespace tactus::host
