#include "host_tools/explain/steps_csv.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "rendering/contact/implicit_sample.h"

namespace tactus::host {
namespace {

// The columns after t_s, tick and row, in their order.
enum Column : std::size_t {
  kPass,
  kMove,
  kTool,
  kFrom = kTool + 3,
  kGoal = kFrom + 3,
  kTo = kGoal + 3,
  kSurface = kTo + 3,
  kEnding = kSurface + 3,
  kObject,
  kFeature,
  kFace,
  kEdge,
  kVertex,
  kNormal,
  kToolDistance = kNormal + 3,
  kGoalDistance,
  kMultiplier,
  kFate,
  kFrictionBefore,
  kFriction,
  kStaticRadius,
  kDynamicRadius,
  kLag,
  kValue,
  kHeight,
  kTolerance,
  kDepth,
  kFlags,
  kStepTimes,
  kColumns = kStepTimes + rendering::kTickStepCount,
};

constexpr std::string_view kHeader =
    "t_s,tick,row,pass,move,"
    "tool_x_m,tool_y_m,tool_z_m,from_x_m,from_y_m,from_z_m,goal_x_m,goal_y_m,goal_z_m,"
    "to_x_m,to_y_m,to_z_m,surface_x_m,surface_y_m,surface_z_m,ending,"
    "object,feature,face,edge,vertex,normal_x,normal_y,normal_z,"
    "tool_distance_m,goal_distance_m,multiplier_m,fate,"
    "friction_before,friction,static_radius_m,dynamic_radius_m,lag_m,"
    "value,height_m,tolerance_m,depth_m,flags,"
    "read_ns,tool_ns,collision_ns,proxy_ns,force_ns,command_ns,objects_ns\n";

std::string_view name_of(MoveEnding ending) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"arrived", "stopped", "border", "held", "settled", "put back", "cut"});
  return kNames[static_cast<std::size_t>(ending)];
}

std::string_view name_of(IterationEnding ending) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"arrived", "stopped", "settled", "cut", "free"});
  return kNames[static_cast<std::size_t>(ending)];
}

std::string_view name_of(PlaneFate fate) {
  constexpr auto kNames = std::to_array<std::string_view>({"active", "not reached", "redundant"});
  return kNames[static_cast<std::size_t>(fate)];
}

// The fields of one row; those that are not set are empty.
class Row {
 public:
  void set(Column column, std::string_view text) { fields_[column] = text; }
  template <class Number>
  void set(Column column, Number number) {
    fields_[column] = fmt::format("{}", number);
  }
  // A vector takes three columns.
  void set(Column column, const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) {
      fields_[column + static_cast<std::size_t>(axis)] = fmt::format("{}", v[axis]);
    }
  }
  void set(const ExplainedFeature& feature) {
    set(kObject, feature.object);
    set(kFeature, static_cast<int>(feature.kind));
    set(kFace, feature.face);
    if (feature.kind == rendering::ContactKind::edge) {
      set(kEdge, feature.edge);
    }
    if (feature.kind == rendering::ContactKind::vertex) {
      set(kVertex, feature.vertex);
    }
  }

  // Sets what a move and an iteration have in common.
  template <class Step>
  void set_step(const Step& step) {
    set(kFrom, step.from_W);
    set(kGoal, step.goal_W);
    set(kTo, step.to_W);
    set(kEnding, name_of(step.ending));
  }

  // Appends the row to the file.
  void write(LogFile& file, const ExplainedTick& tick, std::string_view kind) const {
    std::string& line = file.buffer();
    fmt::format_to(std::back_inserter(line), "{},{},{}", tick.t_s, tick.number, kind);
    for (const std::string& field : fields_) {
      line += ',';
      line += field;
    }
    line += '\n';
    file.flush_if_full();
  }

 private:
  std::array<std::string, kColumns> fields_;
};

void add_move(LogFile& file, const ExplainedTick& tick, std::size_t number) {
  const ExplainedMove& move = tick.moves[number];
  Row row;
  row.set(kPass, move.pass);
  row.set(kMove, number);
  row.set(kTool, move.tool_W);
  row.set_step(move);
  if (move.stopped_by) {
    row.set(kObject, move.stopped_by->object);
    row.set(kFace, move.stopped_by->face);
  }
  row.set(kFrictionBefore, static_cast<int>(move.friction_before));
  row.set(kFriction, static_cast<int>(move.friction));
  if (move.circle) {
    row.set(kStaticRadius, move.circle->static_radius_m);
    row.set(kDynamicRadius, move.circle->dynamic_radius_m);
    row.set(kLag, move.circle->lag_m);
  }
  row.write(file, tick, "move");
  for (const ExplainedPlane& plane : move.planes) {
    Row of_plane;
    of_plane.set(kPass, move.pass);
    of_plane.set(kMove, number);
    of_plane.set(plane.feature);
    of_plane.set(kSurface, plane.surface_W);
    of_plane.set(kNormal, plane.normal_W);
    of_plane.set(kToolDistance, plane.tool_distance_m);
    of_plane.set(kGoalDistance, plane.goal_distance_m);
    of_plane.set(kMultiplier, plane.multiplier_m);
    of_plane.set(kFate, name_of(plane.fate));
    of_plane.write(file, tick, "plane");
  }
}

void add_iteration(LogFile& file, const ExplainedTick& tick, std::size_t number) {
  const ExplainedIteration& iteration = tick.iterations[number];
  Row row;
  row.set(kMove, number);
  row.set(kObject, iteration.object);
  row.set_step(iteration);
  if (iteration.normal_W != Vec3::Zero()) {
    row.set(kNormal, iteration.normal_W);
    row.set(kHeight, iteration.height_m);
  }
  row.set(kValue, iteration.value);
  row.set(kTolerance, rendering::kImplicitReach_m);
  row.set(kFriction, static_cast<int>(iteration.friction));
  row.write(file, tick, "iteration");
}

void add_tick(LogFile& file, const ExplainedTick& tick) {
  const rendering::Touch& touch = tick.touch;
  Row row;
  row.set(kTool, tick.tool_W);
  row.set(kFrom, tick.from_W);
  row.set(kTo, touch.proxy_W);
  row.set(kFrictionBefore, static_cast<int>(tick.friction_before));
  row.set(kFriction, static_cast<int>(touch.friction));
  row.set(kFlags, touch.flags);
  row.set(kDepth, touch.depth_m);
  row.set(kFeature, static_cast<int>(touch.contact));
  if (touch.contact != rendering::ContactKind::none) {
    if (tick.feature && tick.feature->object == touch.object) {
      row.set(*tick.feature);
    }
    row.set(kObject, touch.object);
    row.set(kSurface, tick.surface_W);
    row.set(kNormal, touch.normal_W);
  }
  if (tick.step_ns) {
    for (std::size_t step = 0; step < tick.step_ns->size(); ++step) {
      row.set(static_cast<Column>(kStepTimes + step), (*tick.step_ns)[step]);
    }
  }
  row.write(file, tick, "tick");
}

}  // namespace

StepsCsv::StepsCsv(const std::filesystem::path& path) : file_(path, kHeader) {}

void StepsCsv::add(const ExplainedTick& tick) {
  for (std::size_t number = 0; number < tick.moves.size(); ++number) {
    add_move(file_, tick, number);
  }
  for (std::size_t number = 0; number < tick.iterations.size(); ++number) {
    add_iteration(file_, tick, number);
  }
  for (const ExplainedFeature& feature : tick.walked_to) {
    Row row;
    row.set(feature);
    row.write(file_, tick, "feature");
  }
  add_tick(file_, tick);
}

}  // namespace tactus::host
