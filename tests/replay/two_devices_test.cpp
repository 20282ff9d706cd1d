// Two Falcons lift a cube in the simulation: a recording of each replays to the same hashes, and
// the force of one goes with a fault of the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "firmware/safety/faults.h"
#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/input_error.h"
#include "host_tools/replay/replay.h"
#include "host_tools/simulation/run.h"
#include "host_tools/simulation/run_recording.h"
#include "rendering/scene/scene_world.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"

namespace tactus::testing {
namespace {

class TwoDevices : public FolderTest {
 protected:
  TwoDevices() {
    const std::string example = in_repository("host_tools/examples/grasp/");
    const std::string image = file("grasp.tactus");
    host::bake_file(example + "scene.toml", image);
    scene_ = std::make_unique<host::MappedScene>(image);
    options_ = {.devices = {"falcon"},
                .hands = {"firm"},
                .paths = {example + "thumb.csv", example + "finger.csv"}};
  }

  // Returns the simulation of `options_`, whose plan is then `plan_`.
  std::unique_ptr<host::Simulation> simulated() {
    const auto& image = scene_->image();
    plan_ = host::plan_run(options_, image.objects(), image.tool_radius_m());
    plan_.devices.front().world = rendering::world_of(image);
    return std::make_unique<host::Simulation>(plan_.devices, image.objects(),
                                              image.tool_radius_m());
  }

  // Records a run, and returns the height of the cube after each tick, m.
  std::vector<double> record_both() {
    const auto simulation = simulated();
    std::array<host::RunRecording, 2> recordings{
        host::RunRecording(files_[0], *simulation, scene_->bytes(), 0),
        host::RunRecording(files_[1], *simulation, scene_->bytes(), 1)};
    std::vector<double> heights;
    host::run(*simulation, plan_.seconds, 1000.0, [&](const host::Simulation& now) {
      heights.push_back(now.controller().world().body(1)->motion().center_W.y());
      for (host::RunRecording& recording : recordings) {
        recording.add(now);
      }
    });
    for (host::RunRecording& recording : recordings) {
      recording.close();
    }
    return heights;
  }

  std::unique_ptr<host::MappedScene> scene_;
  host::RunOptions options_;
  host::RunPlan plan_;
  std::array<std::string, 2> files_{file("run.mcap"), file("run.2.mcap")};
};

TEST_F(TwoDevices, LiftACubeAndAreReplayedToTheBit) {
  const std::vector<double> heights = record_both();
  EXPECT_GT(std::ranges::max(heights), heights.front() + 0.05);
  EXPECT_NEAR(heights.back(), heights.front(), 1e-5);  // dropped

  host::RecordedRun first(files_[0], {});
  host::RecordedRun second(files_[1], {});
  const std::array<host::RecordedRun*, 2> both{&first, &second};
  const host::ReplayResult result = host::replay(both);
  ASSERT_FALSE(result.difference) << result.difference->tick << ' ' << result.difference->field;
  EXPECT_EQ(result.ticks, heights.size());

  // One of them alone, or both in the wrong order, is another run.
  EXPECT_THROW(host::replay(first), host::InputError);
  const std::array<host::RecordedRun*, 2> crossed{&second, &first};
  EXPECT_THROW(host::replay(crossed), host::InputError);
}

TEST_F(TwoDevices, LoseTheirForceTogetherOrAlone) {
  for (const firmware::OnFault on_fault : {firmware::OnFault::all, firmware::OnFault::own}) {
    options_.faults = {"2:lost@2"};
    const auto begun = simulated();  // plans the devices
    plan_.devices[1].controller.on_fault = on_fault;
    const auto& image = scene_->image();
    host::Simulation simulation(plan_.devices, image.objects(), image.tool_radius_m());
    host::run(simulation, 2.1, 1000.0, [](const host::Simulation&) {});
    const firmware::TelemetryRecord& thumb = simulation.record(0);
    const firmware::TelemetryRecord& finger = simulation.record(1);
    EXPECT_EQ(finger.faults, firmware::kFaultDeviceLost);
    EXPECT_EQ(finger.force_commanded_W, firmware::Triple{});
    const bool stops_all = on_fault == firmware::OnFault::all;
    EXPECT_EQ(thumb.faults, stops_all ? firmware::kFaultOtherDevice : firmware::kNoFault);
    EXPECT_EQ(thumb.fault_device, stops_all ? 2U : 0U);
    EXPECT_EQ(thumb.mode, stops_all ? firmware::Mode::fault : firmware::Mode::active);
  }
}

}  // namespace
}  // namespace tactus::testing
