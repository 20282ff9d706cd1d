#include "host_tools/monitor/watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "firmware/safety/faults.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/record_columns.h"
#include "tests/unit/host_tools/monitor/example_run.h"

namespace tactus::host {
namespace {

TEST(Watch, PrintsTheUsualFields) {
  WatchLines lines({}, 1);
  firmware::RecordedTick tick = example_tick(7, 3);
  tick.record.faults = firmware::kFaultJointLimit | firmware::kFaultDrive;
  EXPECT_EQ(lines.line(tick),
            "tick=7 mode=active faults=joint_limit,drive limits=none tool_x_m=0.0101 "
            "tool_y_m=-0.0202 tool_z_m=0.0303 proxy_x_m=0.0101 proxy_y_m=-0.0202 "
            "proxy_z_m=0.031534 contact=face force_x_N=0 force_y_N=0.6 force_z_N=0.8");
}

TEST(Watch, PrintsTheFieldsAskedForInTheirOrder) {
  WatchLines lines({"force_z_N", "joint", "mode", "energy"}, 1);
  const std::string line = lines.line(example_tick(7, 3));
  EXPECT_TRUE(
      line.starts_with("force_z_N=0.8 joint1=0.1 joint2=-1.25 joint3=3.14159265 "
                       "mode=active energy_contact"))
      << line;
}

TEST(Watch, AColumnsWholeNameMeansItAlone) {
  WatchLines lines({"tick"}, 1);
  EXPECT_EQ(lines.line(example_tick(7, 3)), "tick=7");
}

TEST(Watch, PassesTicksOver) {
  WatchLines lines({"tick"}, 3);
  std::string all;
  for (std::uint64_t tick = 5; tick < 12; ++tick) {
    all += lines.line(example_tick(tick, 3)) + ";";
  }
  EXPECT_EQ(all, "tick=5;;;tick=8;;;tick=11;");
}

TEST(Watch, NamesTheFieldsThereAreWhenOneIsNotKnown) {
  WatchLines lines({"forse"}, 1);
  try {
    lines.line(example_tick(7, 3));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("there is no field 'forse'; there are: tick")) << message;
    EXPECT_TRUE(message.contains(" force_x_N "));
    EXPECT_FALSE(message.contains("joint4"));
  }
}

TEST(Watch, EveryFieldCanBeAskedForByItsName) {
  for (const std::string& field : column_names(6)) {
    firmware::RecordedTick tick = example_tick(7, 3);
    tick.joint_count = 6;
    WatchLines lines({field}, 1);
    const std::string line = lines.line(tick);
    EXPECT_TRUE(line.starts_with(field + "=")) << line;
    EXPECT_EQ(std::ranges::count(line, ' '), 0) << line;
  }
}

TEST(Watch, KeepsItsColumnsWhateverLaterTicksSay) {
  WatchLines lines({"joint", "mode"}, 1);
  lines.line(example_tick(1, 3));
  firmware::RecordedTick tick = example_tick(2, 3);
  tick.joint_count = ~0U;
  tick.record.mode = static_cast<firmware::Mode>(9);
  const std::string line = lines.line(tick);
  EXPECT_TRUE(line.ends_with("joint3=3.14159265 mode=9")) << line;
}

TEST(Watch, EventsAreLinesOfTheirOwn) {
  firmware::TelemetryEvent event{
      .tick = 7, .time_ns = 0, .kind = firmware::EventKind::parameter, .name = {}, .value = 1000.0};
  firmware::set_name(event, "stiffness");
  EXPECT_EQ(WatchLines::line(event), "event tick=7 kind=parameter name=stiffness value=1000");
}

TEST(Watch, AContactMethodAndAFrictionModelHaveTheirNames) {
  firmware::TelemetryEvent event{
      .tick = 7, .time_ns = 0, .kind = firmware::EventKind::parameter, .name = {}, .value = 5.0};
  firmware::set_name(event, "object.0.contact");
  EXPECT_EQ(WatchLines::line(event),
            "event tick=7 kind=parameter name=object.0.contact value=one_plane");
  firmware::set_name(event, "object.12.friction_model");
  EXPECT_EQ(WatchLines::line(event),
            "event tick=7 kind=parameter name=object.12.friction_model value=lugre");
}

}  // namespace
}  // namespace tactus::host
