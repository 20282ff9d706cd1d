// Visits every field of a record with its name, for CSV files, comparisons and displays. Pure
// functions for any thread.
//
// A new field of TelemetryRecord or RecordedTick gets its line here, its place in record.fbs, and
// its lines in firmware/linux/telemetry/record_encoder.cpp and
// host_tools/recording/record_decoder.cpp; tests hold all of them against each other.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

#include "firmware/safety/energy_ledger.h"
#include "firmware/telemetry/recorded_tick.h"

namespace tactus::firmware {

// The names of a field. The name of a CSV column is `column`, then for arrays the element (1, 2, ..
// for joints, x, y, z of a triple, or an energy source), then the unit: joint1, tool_x_m.
struct FieldName {
  // The name in the struct.
  std::string_view name;
  // The beginning of the CSV column's name.
  std::string_view column;
  // The unit as it stands in the column's name; empty without one.
  std::string_view unit;
};

// Calls visit(FieldName, field) for each field in order. Record: TelemetryRecord, const or not.
template <class Record, class Visit>
void visit_record_fields(Record& record, Visit&& visit) {
  visit(FieldName{"tick", "tick", ""}, record.tick);
  visit(FieldName{"time_s", "time", "s"}, record.time_s);
  visit(FieldName{"mode", "mode", ""}, record.mode);
  visit(FieldName{"request", "request", ""}, record.request);
  visit(FieldName{"contact", "contact", ""}, record.contact);
  visit(FieldName{"friction", "friction", ""}, record.friction);
  visit(FieldName{"faults", "faults", ""}, record.faults);
  visit(FieldName{"limits", "limits", ""}, record.limits);
  visit(FieldName{"device_status", "device_status", ""}, record.device_status);
  visit(FieldName{"sample_age_us", "sample_age", "us"}, record.sample_age_us);
  visit(FieldName{"loop_status", "loop_status", ""}, record.loop_status);
  visit(FieldName{"missed_ticks", "missed_ticks", ""}, record.missed_ticks);
  visit(FieldName{"touch_flags", "touch_flags", ""}, record.touch_flags);
  visit(FieldName{"object", "object", ""}, record.object);
  visit(FieldName{"sub_goals", "sub_goals", ""}, record.sub_goals);
  visit(FieldName{"planes", "planes", ""}, record.planes);
  visit(FieldName{"joint_position", "joint", ""}, record.joint_position);
  visit(FieldName{"joint_velocity", "velocity", ""}, record.joint_velocity);
  visit(FieldName{"joint_effort", "effort", ""}, record.joint_effort);
  visit(FieldName{"tool_p_W", "tool", "m"}, record.tool_p_W);
  visit(FieldName{"tool_v_W", "tool_v", "m_per_s"}, record.tool_v_W);
  visit(FieldName{"proxy_W", "proxy", "m"}, record.proxy_W);
  visit(FieldName{"normal_W", "normal", ""}, record.normal_W);
  visit(FieldName{"force_rendered_W", "rendered", "N"}, record.force_rendered_W);
  visit(FieldName{"force_commanded_W", "force", "N"}, record.force_commanded_W);
  visit(FieldName{"depth_m", "depth", "m"}, record.depth_m);
  visit(FieldName{"passivity_J", "passivity", "J"}, record.passivity_J);
  visit(FieldName{"counters.stale_samples", "stale_samples", ""}, record.counters.stale_samples);
  visit(FieldName{"counters.faults_entered", "faults_entered", ""}, record.counters.faults_entered);
  visit(FieldName{"counters.limited_ticks", "limited_ticks", ""}, record.counters.limited_ticks);
  visit(FieldName{"counters.touch_flagged", "touch_flagged", ""}, record.counters.touch_flagged);
  visit(FieldName{"counters.late_ticks", "late_ticks", ""}, record.counters.late_ticks);
  visit(FieldName{"state_hash", "state_hash", ""}, record.state_hash);
  visit(FieldName{"joint_compensation", "compensation", ""}, record.joint_compensation);
  visit(FieldName{"joint_gravity", "gravity", ""}, record.joint_gravity);
  visit(FieldName{"energy_J", "energy", "J"}, record.energy_J);
  visit(FieldName{"limited_source", "limited_source", ""}, record.limited_source);
  visit(FieldName{"change.parameter", "changed_parameter", ""}, record.change.place.parameter);
  visit(FieldName{"change.object", "changed_object", ""}, record.change.place.object);
  visit(FieldName{"change.value", "changed_value", ""}, record.change.value);
  visit(FieldName{"joint_measured", "measured", ""}, record.joint_measured);
  visit(FieldName{"effort_known", "effort_known", ""}, record.effort_known);
  visit(FieldName{"effort_is_new", "effort_is_new", ""}, record.effort_is_new);
  visit(FieldName{"fault_joint", "fault_joint", ""}, record.fault_joint);
  visit(FieldName{"fault_device", "fault_device", ""}, record.fault_device);
  visit(FieldName{"short_of_goal_m", "short_of_goal", "m"}, record.short_of_goal_m);
  visit(FieldName{"stage_ns.read", "read", "ns"}, record.stage_ns.read);
  visit(FieldName{"stage_ns.check", "check", "ns"}, record.stage_ns.check);
  visit(FieldName{"stage_ns.kinematics", "kinematics", "ns"}, record.stage_ns.kinematics);
  visit(FieldName{"stage_ns.touch", "touch", "ns"}, record.stage_ns.touch);
  visit(FieldName{"stage_ns.safety", "safety", "ns"}, record.stage_ns.safety);
  visit(FieldName{"stage_ns.write", "write", "ns"}, record.stage_ns.write);
}

// Calls visit for the fields of the record, then for those of the loop. Tick: RecordedTick, const
// or not.
template <class Tick, class Visit>
void visit_tick_fields(Tick& tick, Visit&& visit) {
  visit_record_fields(tick.record, visit);
  visit(FieldName{"loop.scheduled_ns", "scheduled", "ns"}, tick.loop.scheduled_ns);
  visit(FieldName{"loop.woke_ns", "woke", "ns"}, tick.loop.woke_ns);
  visit(FieldName{"loop.done_ns", "done", "ns"}, tick.loop.done_ns);
  visit(FieldName{"loop.sample_ns", "sample", "ns"}, tick.loop.sample_ns);
  visit(FieldName{"shaft_rad", "shaft", "rad"}, tick.shaft_rad);
  visit(FieldName{"torque_Nm", "torque", "Nm"}, tick.torque_Nm);
  visit(FieldName{"joint_count", "joints", ""}, tick.joint_count);
  visit(FieldName{"dropped", "dropped", ""}, tick.dropped);
}

// The name of a column: the names of its field, and the element of the field in two parts, which
// are empty if the field is one number: "_" and "x", "" and "1", "_" and "contact".
struct ColumnName {
  FieldName field;
  std::string_view before;
  std::string_view element;
};

// Calls visit(ColumnName, value) for each column of a tick in order: a triple has three, an array
// of joints as many as there are joints, the energy one for each source.
template <class Visit>
void visit_tick_columns(const RecordedTick& tick, std::size_t joints, Visit&& visit) {
  static constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  static constexpr std::array<std::string_view, drivers::kMaxJoints> kJoints = {"1", "2", "3",
                                                                                "4", "5", "6"};
  static_assert(!kJoints.back().empty());
  visit_tick_fields(tick, [&]<class Field>(const FieldName& name, const Field& field) {
    const auto visit_each = [&](std::string_view before, const auto& elements, const auto& values) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        visit(ColumnName{name, before, elements[i]}, values[i]);
      }
    };
    if constexpr (std::is_same_v<Field, Triple>) {
      visit_each("_", kAxes, field);
    } else if constexpr (std::is_same_v<Field, std::array<double, drivers::kMaxJoints>>) {
      visit_each("", kJoints, std::span(field).first(std::min(joints, field.size())));
    } else if constexpr (std::is_same_v<Field, EnergyLedger>) {
      visit_each("_", kEnergySourceNames, field);
    } else {
      visit(ColumnName{name, "", ""}, field);
    }
  });
}

}  // namespace tactus::firmware
