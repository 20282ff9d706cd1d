#include "firmware/linux/telemetry/record_encoder.h"

#include <algorithm>
#include <exception>

#include "firmware/telemetry/event_bfbs_generated.h"
#include "firmware/telemetry/event_generated.h"
#include "firmware/telemetry/explanation_bfbs_generated.h"
#include "firmware/telemetry/explanation_generated.h"
#include "firmware/telemetry/object_places_generated.h"
#include "firmware/telemetry/record_bfbs_generated.h"
#include "firmware/telemetry/record_generated.h"
#include "firmware/telemetry/run_info_generated.h"

namespace tactus::firmware {
namespace {

telemetry::Vector3 stored(const Triple& triple) {
  return {triple[0], triple[1], triple[2]};
}

// Converts an enumerator to the schema's type. Both have the same values; a test checks that.
template <class Stored, class Ours>
Stored stored_enum(Ours value) {
  return static_cast<Stored>(value);
}

// Returns the values of one joint.
telemetry::Joint stored_joint(const RecordedTick& tick, std::size_t i) {
  const TelemetryRecord& record = tick.record;
  return {record.joint_position[i], record.joint_velocity[i],
          record.joint_effort[i],   record.joint_compensation[i],
          record.joint_gravity[i],  tick.shaft_rad[i],
          tick.torque_Nm[i]};
}

telemetry::EnergyLedger stored_energy(const EnergyLedger& energy_J) {
  const auto of = [&](EnergySource source) { return energy_J[static_cast<std::size_t>(source)]; };
  using enum EnergySource;
  return {of(contact), of(friction), of(texture), of(effect), of(coupling), of(safety), of(delay)};
}

telemetry::Feature stored_feature(const rendering::ExplainedFeature& feature) {
  return {feature.object, feature.face, feature.edge, feature.vertex,
          stored_enum<telemetry::ContactKind>(feature.kind)};
}

telemetry::StepTimes stored_steps(const StepTimes& step_ns) {
  const auto of = [&](rendering::TickStep step) { return step_ns[static_cast<std::size_t>(step)]; };
  using enum rendering::TickStep;
  return {of(read), of(tool), of(collision), of(proxy), of(force), of(command), of(objects)};
}

// Adds the fields that are numbers.
void add_state(telemetry::RecordBuilder& table, const TelemetryRecord& record) {
  table.add_tick(record.tick);
  table.add_time_s(record.time_s);
  table.add_mode(stored_enum<telemetry::Mode>(record.mode));
  table.add_request(stored_enum<telemetry::Request>(record.request));
  table.add_contact(stored_enum<telemetry::ContactKind>(record.contact));
  table.add_friction(stored_enum<telemetry::FrictionState>(record.friction));
  table.add_faults(record.faults);
  table.add_limits(record.limits);
  table.add_device_status(record.device_status);
  table.add_sample_age_us(record.sample_age_us);
  table.add_loop_status(record.loop_status);
  table.add_missed_ticks(record.missed_ticks);
  table.add_touch_flags(record.touch_flags);
  table.add_object(record.object);
  table.add_sub_goals(record.sub_goals);
  table.add_planes(record.planes);
  table.add_depth_m(record.depth_m);
  table.add_passivity_j(record.passivity_J);
  table.add_limited_source(stored_enum<telemetry::EnergySource>(record.limited_source));
  table.add_state_hash(record.state_hash);
  table.add_effort_known(record.effort_known);
  table.add_effort_is_new(record.effort_is_new);
  table.add_fault_joint(record.fault_joint);
  table.add_short_of_goal_m(record.short_of_goal_m);
  table.add_fault_device(record.fault_device);
}

}  // namespace

std::uint8_t* RecordEncoder::Memory::allocate(std::size_t size) {
  if (size > bytes_.size()) {
    std::terminate();  // a message longer than kMaxMessageBytes: broken invariant
  }
  return bytes_.data();
}

void RecordEncoder::Memory::deallocate(std::uint8_t* /*memory*/, std::size_t /*size*/) {}

RecordEncoder::RecordEncoder() : builder_(kMaxMessageBytes, &memory_) {
  builder_.ForceDefaults(true);  // every message of a kind has the same length
}

std::span<const std::byte> RecordEncoder::encode(const RecordedTick& tick) {
  builder_.Clear();
  const TelemetryRecord& record = tick.record;
  const std::size_t count = std::min<std::size_t>(tick.joint_count, drivers::kMaxJoints);
  std::array<telemetry::Joint, drivers::kMaxJoints> joints;
  for (std::size_t i = 0; i < count; ++i) {
    joints[i] = stored_joint(tick, i);
  }
  const auto stored_joints = builder_.CreateVectorOfStructs(joints.data(), count);
  const auto measured = builder_.CreateVector(record.joint_measured.data(), count);
  const telemetry::Vector3 tool_p = stored(record.tool_p_W);
  const telemetry::Vector3 tool_v = stored(record.tool_v_W);
  const telemetry::Vector3 proxy = stored(record.proxy_W);
  const telemetry::Vector3 normal = stored(record.normal_W);
  const telemetry::Vector3 rendered = stored(record.force_rendered_W);
  const telemetry::Vector3 commanded = stored(record.force_commanded_W);
  const telemetry::Counters counters(record.counters.stale_samples, record.counters.faults_entered,
                                     record.counters.limited_ticks, record.counters.touch_flagged,
                                     record.counters.late_ticks);
  const telemetry::EnergyLedger energy = stored_energy(record.energy_J);
  const ParameterPlace& place = record.change.place;
  const telemetry::ParameterChange change(static_cast<std::uint8_t>(place.parameter), place.object,
                                          record.change.value);
  const StageTimes& stages = record.stage_ns;
  const telemetry::StageTimes stage_ns(stages.read, stages.check, stages.kinematics, stages.touch,
                                       stages.safety, stages.write);
  const telemetry::LoopTimes loop(tick.loop.scheduled_ns, tick.loop.woke_ns, tick.loop.done_ns,
                                  tick.loop.sample_ns);
  telemetry::RecordBuilder table(builder_);
  add_state(table, record);
  table.add_joints(stored_joints);
  table.add_tool_p_w(&tool_p);
  table.add_tool_v_w(&tool_v);
  table.add_proxy_w(&proxy);
  table.add_normal_w(&normal);
  table.add_force_rendered_w(&rendered);
  table.add_force_commanded_w(&commanded);
  table.add_counters(&counters);
  table.add_energy_j(&energy);
  table.add_change(&change);
  table.add_stage_ns(&stage_ns);
  table.add_loop(&loop);
  table.add_dropped(tick.dropped);
  table.add_measured(measured);
  builder_.Finish(table.Finish(), telemetry::RecordIdentifier());
  return message();
}

std::span<const std::byte> RecordEncoder::encode(const TelemetryEvent& event) {
  builder_.Clear();
  const std::string_view name = name_of(event);
  const auto stored_name = builder_.CreateString(name.data(), name.size());
  telemetry::EventBuilder table(builder_);
  table.add_tick(event.tick);
  table.add_time_ns(event.time_ns);
  table.add_kind(stored_enum<telemetry::EventKind>(event.kind));
  table.add_name(stored_name);
  table.add_value(event.value);
  builder_.Finish(table.Finish(), telemetry::EventIdentifier());
  return message();
}

std::span<const std::byte> RecordEncoder::encode(const Explanation& explanation) {
  builder_.Clear();
  std::array<telemetry::ActivePlane, kMaxActivePlanes> planes;
  const std::size_t count = std::min<std::size_t>(explanation.plane_count, planes.size());
  for (std::size_t i = 0; i < count; ++i) {
    const ActivePlane& plane = explanation.planes[i];
    planes[i] = {stored_feature(plane.feature), stored(plane.normal_W), plane.tool_distance_m,
                 plane.multiplier_m};
  }
  const auto stored_planes = builder_.CreateVectorOfStructs(planes.data(), count);
  const telemetry::Feature feature = stored_feature(explanation.feature);
  const telemetry::Vector3 tool = stored(explanation.tool_W);
  const telemetry::Vector3 proxy = stored(explanation.proxy_W);
  const telemetry::Vector3 surface = stored(explanation.surface_W);
  const telemetry::Vector3 normal = stored(explanation.normal_W);
  const auto& [static_radius_m, dynamic_radius_m, lag_m] = explanation.circle;
  const telemetry::FrictionCircle circle(static_radius_m, dynamic_radius_m, lag_m);
  const telemetry::StepTimes step_ns = stored_steps(explanation.step_ns);
  telemetry::ExplanationBuilder table(builder_);
  table.add_tick(explanation.tick);
  table.add_time_ns(explanation.time_ns);
  table.add_feature(&feature);
  table.add_is_feature_known(explanation.is_feature_known);
  table.add_friction(stored_enum<telemetry::FrictionState>(explanation.friction));
  table.add_moves(explanation.moves);
  table.add_iterations(explanation.iterations);
  table.add_tool_w(&tool);
  table.add_proxy_w(&proxy);
  table.add_surface_w(&surface);
  table.add_normal_w(&normal);
  table.add_depth_m(explanation.depth_m);
  table.add_planes(stored_planes);
  if (explanation.has_circle) {
    table.add_circle(&circle);
  }
  table.add_step_ns(&step_ns);
  builder_.Finish(table.Finish(), telemetry::ExplanationIdentifier());
  return message();
}

std::span<const std::byte> RecordEncoder::encode(const ObjectPlaces& places) {
  builder_.Clear();
  std::array<telemetry::ObjectPlace, rendering::kMaxMovers> stored_places;
  const std::size_t count = std::min<std::size_t>(places.count, stored_places.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [object, origin_W, rotation_W] = places.places[i];
    stored_places[i] = {
        object, stored(origin_W), {rotation_W[0], rotation_W[1], rotation_W[2], rotation_W[3]}};
  }
  const auto list = builder_.CreateVectorOfStructs(stored_places.data(), count);
  telemetry::ObjectPlacesBuilder table(builder_);
  table.add_tick(places.tick);
  table.add_time_ns(places.time_ns);
  table.add_places(list);
  builder_.Finish(table.Finish(), telemetry::ObjectPlacesIdentifier());
  return message();
}

std::span<const std::byte> RecordEncoder::encode(std::span<const MetadataEntry> run_info) {
  constexpr std::size_t kMaxEntries = 64;
  constexpr std::size_t kPerEntry = 64;  // more than the tables around the two texts
  builder_.Clear();
  std::array<flatbuffers::Offset<telemetry::Entry>, kMaxEntries> entries;
  std::size_t count = 0;
  for (const MetadataEntry& entry : run_info.first(std::min(run_info.size(), kMaxEntries))) {
    // Half of the buffer stays free for the tables and the builder's notes.
    if (builder_.GetSize() + entry.key.size() + entry.value.size() + kPerEntry >
        kMaxMessageBytes / 2) {
      break;
    }
    const auto key = builder_.CreateString(entry.key.data(), entry.key.size());
    const auto value = builder_.CreateString(entry.value.data(), entry.value.size());
    entries[count] = telemetry::CreateEntry(builder_, key, value);
    ++count;
  }
  const auto stored_entries = builder_.CreateVector(entries.data(), count);
  builder_.Finish(telemetry::CreateRunInfo(builder_, stored_entries),
                  telemetry::RunInfoIdentifier());
  return message();
}

std::span<const std::byte> RecordEncoder::message() const {
  return std::as_bytes(std::span(builder_.GetBufferPointer(), builder_.GetSize()));
}

MessageSchema record_schema() {
  using Schema = telemetry::RecordBinarySchema;
  return {.name = "tactus.telemetry.Record",
          .bytes = std::as_bytes(std::span(Schema::data(), Schema::size()))};
}

MessageSchema explanation_schema() {
  using Schema = telemetry::ExplanationBinarySchema;
  return {.name = "tactus.telemetry.Explanation",
          .bytes = std::as_bytes(std::span(Schema::data(), Schema::size()))};
}

MessageSchema event_schema() {
  using Schema = telemetry::EventBinarySchema;
  return {.name = "tactus.telemetry.Event",
          .bytes = std::as_bytes(std::span(Schema::data(), Schema::size()))};
}

}  // namespace tactus::firmware
