#include "host_tools/recording/record_decoder.h"

#include <algorithm>
#include <cstdint>

#include "firmware/telemetry/event_generated.h"
#include "firmware/telemetry/explanation_generated.h"
#include "firmware/telemetry/object_places_generated.h"
#include "firmware/telemetry/record_generated.h"
#include "firmware/telemetry/run_info_generated.h"

namespace tactus::host {
namespace {

using firmware::RecordedTick;
using firmware::TelemetryEvent;
using firmware::TelemetryRecord;
using firmware::Triple;

// A copy of a message at an aligned address. FlatBuffers reads numbers in place, so they must be
// aligned as the processor demands, while a chunk puts messages at any byte.
class AlignedMessage {
 public:
  explicit AlignedMessage(std::span<const std::byte> bytes)
      : size_(bytes.size()), words_(bytes.size() / sizeof(Word) + 1) {
    std::ranges::copy(bytes, std::as_writable_bytes(std::span(words_)).begin());
  }
  [[nodiscard]] const std::uint8_t* data() const {
    return reinterpret_cast<const std::uint8_t*>(words_.data());
  }
  [[nodiscard]] flatbuffers::Verifier verifier() const { return {data(), size_}; }

 private:
  using Word = std::uint64_t;
  std::size_t size_;
  std::vector<Word> words_;
};

Triple read_triple(const telemetry::Vector3& stored) {
  return {stored.x(), stored.y(), stored.z()};
}

rendering::ExplainedFeature read_feature(const telemetry::Feature& stored) {
  return {.object = stored.object(),
          .kind = static_cast<rendering::ContactKind>(stored.kind()),
          .face = stored.face(),
          .edge = stored.edge(),
          .vertex = stored.vertex()};
}

// Reads the active planes. Returns false if there are more than a tick can have.
bool read_planes(const telemetry::Explanation& stored, firmware::Explanation& explanation) {
  const auto& planes = *stored.planes();
  const bool is_aligned =
      reinterpret_cast<std::uintptr_t>(planes.Data()) % alignof(telemetry::ActivePlane) == 0;
  if (!is_aligned || planes.size() > firmware::kMaxActivePlanes) {
    return false;
  }
  explanation.plane_count = static_cast<std::uint8_t>(planes.size());
  for (std::uint32_t i = 0; i < planes.size(); ++i) {
    const telemetry::ActivePlane& plane = *planes.Get(i);
    explanation.planes[i] = {.feature = read_feature(plane.feature()),
                             .normal_W = read_triple(plane.normal()),
                             .tool_distance_m = plane.tool_distance_m(),
                             .multiplier_m = plane.multiplier_m()};
  }
  return true;
}

// The fields of record.fbs, one by one.
void read_state(const telemetry::Record& stored, TelemetryRecord& record) {
  record.tick = stored.tick();
  record.time_s = stored.time_s();
  record.mode = static_cast<firmware::Mode>(stored.mode());
  record.request = static_cast<firmware::Request>(stored.request());
  record.contact = static_cast<rendering::ContactKind>(stored.contact());
  record.friction = static_cast<rendering::FrictionState>(stored.friction());
  record.faults = stored.faults();
  record.limits = stored.limits();
  record.device_status = stored.device_status();
  record.sample_age_us = stored.sample_age_us();
  record.loop_status = stored.loop_status();
  record.missed_ticks = stored.missed_ticks();
  record.touch_flags = stored.touch_flags();
  record.object = stored.object();
  record.sub_goals = stored.sub_goals();
  record.planes = stored.planes();
  record.depth_m = stored.depth_m();
  record.passivity_J = stored.passivity_j();
  record.limited_source = static_cast<firmware::EnergySource>(stored.limited_source());
  record.state_hash = stored.state_hash();
  record.effort_known = stored.effort_known();
  record.effort_is_new = stored.effort_is_new();
  record.fault_joint = stored.fault_joint();
  record.short_of_goal_m = stored.short_of_goal_m();
  record.fault_device = stored.fault_device();
}

void read_vectors(const telemetry::Record& stored, TelemetryRecord& record) {
  record.tool_p_W = read_triple(*stored.tool_p_w());
  record.tool_v_W = read_triple(*stored.tool_v_w());
  record.proxy_W = read_triple(*stored.proxy_w());
  record.normal_W = read_triple(*stored.normal_w());
  record.force_rendered_W = read_triple(*stored.force_rendered_w());
  record.force_commanded_W = read_triple(*stored.force_commanded_w());
}

void read_counts(const telemetry::Record& stored, TelemetryRecord& record) {
  const telemetry::Counters& counters = *stored.counters();
  record.counters = {.stale_samples = counters.stale_samples(),
                     .faults_entered = counters.faults_entered(),
                     .limited_ticks = counters.limited_ticks(),
                     .touch_flagged = counters.touch_flagged(),
                     .late_ticks = counters.late_ticks()};
  const telemetry::EnergyLedger& energy = *stored.energy_j();
  record.energy_J = {energy.contact(),  energy.friction(), energy.texture(), energy.effect(),
                     energy.coupling(), energy.safety(),   energy.delay()};
  const telemetry::ParameterChange& change = *stored.change();
  record.change = {.place = {.parameter = static_cast<firmware::Parameter>(change.parameter()),
                             .object = change.object()},
                   .value = change.value()};
  const telemetry::StageTimes& stages = *stored.stage_ns();
  record.stage_ns = {.read = stages.read(),
                     .check = stages.check(),
                     .kinematics = stages.kinematics(),
                     .touch = stages.touch(),
                     .safety = stages.safety(),
                     .write = stages.write()};
}

// Reads the measured positions, of which there are as many as joints. Recordings of an older format
// have none, which is no error.
bool read_measured(const telemetry::Record& stored, RecordedTick& tick) {
  const auto* const measured = stored.measured();
  if (measured == nullptr) {
    return true;
  }
  const bool is_aligned = measured->size() == 0 ||
                          reinterpret_cast<std::uintptr_t>(measured->Data()) % alignof(double) == 0;
  if (!is_aligned || measured->size() != tick.joint_count) {
    return false;
  }
  for (std::uint32_t i = 0; i < measured->size(); ++i) {
    tick.record.joint_measured[i] = measured->Get(i);
  }
  return true;
}

bool read_joints(const telemetry::Record& stored, RecordedTick& tick) {
  const auto& joints = *stored.joints();
  // The verifier checks where a vector begins, not where its first element lies.
  const bool is_aligned =
      reinterpret_cast<std::uintptr_t>(joints.Data()) % alignof(telemetry::Joint) == 0;
  if (!is_aligned || joints.size() > drivers::kMaxJoints) {
    return false;
  }
  tick.joint_count = joints.size();
  for (std::uint32_t i = 0; i < joints.size(); ++i) {
    const telemetry::Joint& joint = *joints.Get(i);
    tick.record.joint_position[i] = joint.position();
    tick.record.joint_velocity[i] = joint.velocity();
    tick.record.joint_effort[i] = joint.effort();
    tick.record.joint_compensation[i] = joint.compensation();
    tick.record.joint_gravity[i] = joint.gravity();
    tick.shaft_rad[i] = joint.shaft_rad();
    tick.torque_Nm[i] = joint.torque_nm();
  }
  return read_measured(stored, tick);
}

}  // namespace

std::optional<RecordedTick> decode_tick(std::span<const std::byte> message) {
  const AlignedMessage aligned(message);
  auto verifier = aligned.verifier();
  if (!telemetry::VerifyRecordBuffer(verifier)) {
    return std::nullopt;
  }
  const telemetry::Record& stored = *telemetry::GetRecord(aligned.data());
  // The dereferences below are safe: the schema marks these fields as required, and the verifier
  // has found them.
  std::optional<RecordedTick> tick(std::in_place);
  read_state(stored, tick->record);
  read_vectors(stored, tick->record);
  read_counts(stored, tick->record);
  const telemetry::LoopTimes& loop = *stored.loop();
  tick->loop = {.scheduled_ns = loop.scheduled_ns(),
                .woke_ns = loop.woke_ns(),
                .done_ns = loop.done_ns(),
                .sample_ns = loop.sample_ns()};
  tick->dropped = stored.dropped();
  if (!read_joints(stored, *tick)) {
    return std::nullopt;
  }
  return tick;
}

std::optional<TelemetryEvent> decode_event(std::span<const std::byte> message) {
  const AlignedMessage aligned(message);
  auto verifier = aligned.verifier();
  if (!telemetry::VerifyEventBuffer(verifier)) {
    return std::nullopt;
  }
  const telemetry::Event& stored = *telemetry::GetEvent(aligned.data());
  TelemetryEvent event{.tick = stored.tick(),
                       .time_ns = stored.time_ns(),
                       .kind = static_cast<firmware::EventKind>(stored.kind()),
                       .value = stored.value()};
  firmware::set_name(event, {stored.name()->c_str(), stored.name()->size()});
  return event;
}

std::optional<firmware::Explanation> decode_explanation(std::span<const std::byte> message) {
  const AlignedMessage aligned(message);
  auto verifier = aligned.verifier();
  if (!telemetry::VerifyExplanationBuffer(verifier)) {
    return std::nullopt;
  }
  const telemetry::Explanation& stored = *telemetry::GetExplanation(aligned.data());
  const telemetry::StepTimes& steps = *stored.step_ns();
  firmware::Explanation explanation{
      .tick = stored.tick(),
      .time_ns = stored.time_ns(),
      .feature = read_feature(*stored.feature()),
      .is_feature_known = stored.is_feature_known(),
      .friction = static_cast<rendering::FrictionState>(stored.friction()),
      .moves = stored.moves(),
      .iterations = stored.iterations(),
      .tool_W = read_triple(*stored.tool_w()),
      .proxy_W = read_triple(*stored.proxy_w()),
      .surface_W = read_triple(*stored.surface_w()),
      .normal_W = read_triple(*stored.normal_w()),
      .depth_m = stored.depth_m(),
      .step_ns = {steps.read(), steps.tool(), steps.collision(), steps.proxy(), steps.force(),
                  steps.command(), steps.objects()}};
  if (const telemetry::FrictionCircle* const circle = stored.circle()) {
    explanation.has_circle = true;
    explanation.circle = {.static_radius_m = circle->static_radius_m(),
                          .dynamic_radius_m = circle->dynamic_radius_m(),
                          .lag_m = circle->lag_m()};
  }
  return read_planes(stored, explanation) ? std::optional(explanation) : std::nullopt;
}

std::optional<firmware::ObjectPlaces> decode_object_places(std::span<const std::byte> message) {
  const AlignedMessage aligned(message);
  auto verifier = aligned.verifier();
  if (!telemetry::VerifyObjectPlacesBuffer(verifier)) {
    return std::nullopt;
  }
  const telemetry::ObjectPlaces& stored = *telemetry::GetObjectPlaces(aligned.data());
  const auto& list = *stored.places();
  firmware::ObjectPlaces places{
      .tick = stored.tick(), .time_ns = stored.time_ns(), .count = list.size()};
  const bool is_aligned =
      reinterpret_cast<std::uintptr_t>(list.Data()) % alignof(telemetry::ObjectPlace) == 0;
  if (!is_aligned || list.size() > places.places.size()) {
    return std::nullopt;
  }
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    const telemetry::ObjectPlace& place = *list.Get(i);
    const telemetry::Quaternion& q = place.rotation();
    places.places[i] = {.object = place.object(),
                        .origin_W = read_triple(place.origin()),
                        .rotation_W = {q.w(), q.x(), q.y(), q.z()}};
  }
  return places;
}

std::optional<RunInfo> decode_run_info(std::span<const std::byte> message) {
  const AlignedMessage aligned(message);
  auto verifier = aligned.verifier();
  if (!telemetry::VerifyRunInfoBuffer(verifier)) {
    return std::nullopt;
  }
  RunInfo info;
  for (const telemetry::Entry* entry : *telemetry::GetRunInfo(aligned.data())->entries()) {
    info.emplace_back(entry->key()->str(), entry->value()->str());
  }
  return info;
}

}  // namespace tactus::host
