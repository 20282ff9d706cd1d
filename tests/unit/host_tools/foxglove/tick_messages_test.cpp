// The messages of a device: poses, markers, and the columns of a recording under their names.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "firmware/safety/faults.h"
#include "host_tools/foxglove/tick_messages.h"
#include "host_tools/recording/record_columns.h"

namespace tactus::host {
namespace {

using nlohmann::json;

constexpr std::uint64_t kTime_ns = 1'700'000'000'250'000'000;
constexpr double kRadius_m = 0.004;

firmware::RecordedTick some_tick() {
  firmware::RecordedTick tick;
  tick.record.tick = 41;
  tick.record.mode = firmware::Mode::active;
  tick.record.contact = rendering::ContactKind::edge;
  tick.record.tool_p_W = {0.01, -0.02, 0.03};
  tick.record.proxy_W = {0.01, -0.01, 0.03};
  tick.record.force_commanded_W = {0.0, 2.5, 0.0};
  tick.record.depth_m = 0.01;
  tick.joint_count = 2;
  tick.loop = {.scheduled_ns = 1000, .woke_ns = 1300, .done_ns = 2000, .sample_ns = 900};
  return tick;
}

class DeviceTopicsTest : public ::testing::Test {
 protected:
  void SetUp() override { topics_.take(tick_, kTime_ns, kRadius_m); }

  // Returns the message of a topic.
  [[nodiscard]] json message(const std::string& topic) const {
    const auto& channels = topics_.channels();
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i].topic == topic) {
        return json::parse(topics_.message(i));
      }
    }
    ADD_FAILURE() << "no topic " << topic;
    return {};
  }

  firmware::RecordedTick tick_ = some_tick();
  DeviceTopics topics_{"", 2};
};

TEST_F(DeviceTopicsTest, ToolAndProxyArePosesInTheWorld) {
  const json tool = message("/tool");
  EXPECT_EQ(tool["frame_id"], "W");
  EXPECT_EQ(tool["timestamp"], json({{"sec", 1'700'000'000}, {"nsec", 250'000'000}}));
  EXPECT_EQ(tool["pose"]["position"], json({{"x", 0.01}, {"y", -0.02}, {"z", 0.03}}));
  EXPECT_EQ(tool["pose"]["orientation"]["w"], 1.0);
  EXPECT_EQ(message("/proxy")["pose"]["position"]["y"], -0.01);
}

TEST_F(DeviceTopicsTest, TheArrowPointsAlongTheForceFromTheTool) {
  const json arrow = message("/markers")["entities"][0]["arrows"][0];
  const json& q = arrow["pose"]["orientation"];
  // An arrow without a rotation points along x.
  const Vec3 along = Eigen::Quaterniond(q["w"], q["x"], q["y"], q["z"]) * Vec3::UnitX();
  EXPECT_NEAR((along - Vec3::UnitY()).norm(), 0.0, 1e-8);
  EXPECT_EQ(arrow["pose"]["position"]["x"], 0.01);
  const double length_m = arrow["shaft_length"].get<double>() + arrow["head_length"].get<double>();
  EXPECT_NEAR(length_m, 0.025, 1e-9);  // ten millimetres a newton
}

TEST_F(DeviceTopicsTest, AToolWithoutForceOrRadiusHasNoArrowAndCanBeSeen) {
  tick_.record.force_commanded_W = {};
  topics_.take(tick_, kTime_ns, 0.0);
  const json entity = message("/markers")["entities"][0];
  EXPECT_TRUE(entity["arrows"].empty());
  ASSERT_EQ(entity["spheres"].size(), 2U);
  EXPECT_GT(entity["spheres"][0]["size"]["x"], 0.0);
}

TEST_F(DeviceTopicsTest, ModesAndFaultsAreWords) {
  tick_.record.faults = firmware::kFaultTexts.front().bit;
  topics_.take(tick_, kTime_ns, kRadius_m);
  const json state = message("/state");
  EXPECT_EQ(state["mode"], "active");
  EXPECT_EQ(state["contact"], "edge");
  EXPECT_EQ(state["limits"], "none");
  EXPECT_EQ(state["faults"], firmware::kFaultTexts.front().name);
  EXPECT_EQ(state["tick"], 41);
}

TEST_F(DeviceTopicsTest, TimesOfTheLoopAreDifferences) {
  const json timing = message("/timing");
  EXPECT_EQ(timing["wake_latency_ns"], 300);
  EXPECT_EQ(timing["busy_ns"], 700);
}

TEST_F(DeviceTopicsTest, NumbersThatJsonHasNotAreLeftOut) {
  tick_.record.force_commanded_W[0] = std::numeric_limits<double>::quiet_NaN();
  tick_.record.depth_m = std::numeric_limits<double>::infinity();
  tick_.record.tool_p_W[2] = -std::numeric_limits<double>::infinity();
  topics_.take(tick_, kTime_ns, kRadius_m);
  const json force = message("/force");
  EXPECT_FALSE(force.contains("force_x_N"));
  EXPECT_FALSE(force.contains("depth_m"));
  EXPECT_EQ(force["force_y_N"], 2.5);
  EXPECT_EQ(message("/tool")["pose"]["position"]["z"], 0.0);
  EXPECT_EQ(message("/markers")["entities"][0]["arrows"].size(), 0U);
}

// Nothing is shown under a name of its own: `tactus watch` and recordings have the same.
TEST_F(DeviceTopicsTest, FieldsHaveTheNamesOfColumnsAndThoseOfTheirSchema) {
  const std::vector<std::string> columns = column_names(2);
  const std::set<std::string> known(columns.begin(), columns.end());
  for (const FoxgloveChannel& channel : topics_.channels()) {
    if (!channel.schema_name.starts_with("tactus.")) {
      continue;
    }
    const json properties = json::parse(channel.schema)["properties"];
    const json sent = message(channel.topic);
    EXPECT_EQ(sent.size(), properties.size()) << channel.topic;
    for (const auto& [name, value] : sent.items()) {
      EXPECT_TRUE(known.contains(name) || name == "wake_latency_ns" || name == "busy_ns") << name;
      ASSERT_TRUE(properties.contains(name)) << name;
      EXPECT_EQ(properties[name]["type"], value.is_number() ? "number" : "string") << name;
    }
  }
}

TEST(DeviceTopics, StandBehindTheNameOfTheirDevice) {
  const DeviceTopics topics("/left", 3);
  for (const FoxgloveChannel& channel : topics.channels()) {
    EXPECT_TRUE(channel.topic.starts_with("/left/")) << channel.topic;
  }
  EXPECT_TRUE(json::parse(topics.channels().back().schema)["properties"].contains("busy_ns"));
}

}  // namespace
}  // namespace tactus::host
