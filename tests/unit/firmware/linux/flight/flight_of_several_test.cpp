// The flight files of a controller with several devices, which replay together.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/flight/flight_writer.h"
#include "host_tools/replay/replay.h"
#include "tests/support/folder_test.h"
#include "tests/support/shapes.h"

namespace tactus::firmware {
namespace {

constexpr std::size_t kDevices = 2;

class FlightOfSeveral : public FolderTest {
 protected:
  FlightOfSeveral() {
    for (std::size_t i = 0; i < kDevices; ++i) {
      ControllerConfig config = cartesian_config();
      config.on_fault = OnFault::own;
      EXPECT_TRUE(controller_->configure(config, i));
      const std::size_t size = save_config(controller_->config(i), config_[i]);
      images_[i] = {
          Attachment{.name = kConfigAttachment, .bytes = std::span(config_[i]).first(size)}};
      info_[i] = {MetadataEntry{kDeviceNumberKey, i == 0 ? "1" : "2"},
                  MetadataEntry{kDeviceCountKey, "2"}};
    }
    writer_->use_room(room_);
    writer_->accompany(*companion_, plan(1));
    EXPECT_EQ(writer_->start(plan(0)), 0);
  }

  FlightPlan plan(std::size_t device) {
    return {.folder = folder(),
            .device = device,
            .run = {.info = info_[device], .joints = 3},
            .images = images_[device]};
  }

  void run(Request first, Request second, int ticks) {
    for (int k = 0; k < ticks; ++k) {
      std::array<drivers::JointSample, kDevices> samples;
      const double shift_m = 1e-5 * static_cast<double>(controller_->next_tick() % 1000);
      samples[0].position = {0.01, 0.02 + shift_m, 0.03};
      samples[1].position = {0.01 + shift_m, 0.02, 0.03};
      std::array<drivers::JointCommand, kDevices> commands;
      controller_->tick(samples, std::array{first, second}, commands);
      companion_->ticks.add({.record = controller_->record(1), .joint_count = 3});
      writer_->add({.record = controller_->record(0), .joint_count = 3}, *controller_);
    }
  }

  // Returns the written files, the first device's before the second's.
  [[nodiscard]] std::array<std::string, kDevices> files() const {
    const std::string first = writer_->path();
    return {first, first.substr(0, first.rfind('.')) + ".2.mcap"};
  }

  std::array<std::array<std::byte, kMaxConfigBytes>, kDevices> config_{};
  std::array<std::array<Attachment, 1>, kDevices> images_{};
  std::array<std::array<MetadataEntry, 2>, kDevices> info_{};
  std::unique_ptr<ControllerOf<kDevices>> controller_ = std::make_unique<ControllerOf<kDevices>>();
  std::vector<std::byte> room_ =
      std::vector<std::byte>(FlightRecorder::kStates * kDevices * kMaxCheckpointBytes);
  std::unique_ptr<FlightCompanion> companion_ = std::make_unique<FlightCompanion>();
  std::unique_ptr<FlightWriter> writer_ = std::make_unique<FlightWriter>();
};

TEST_F(FlightOfSeveral, AFaultOfTheSecondDeviceIsWrittenForBothAndReplays) {
  run(Request::home, Request::home, 1);
  run(Request::none, Request::none, 3000);
  run(Request::none, Request::enable, 1);
  // Begins a second state of the recorder's, so that the files begin within the run.
  run(Request::none, Request::none, static_cast<int>(kFlightTicks));
  ASSERT_EQ(controller_->mode(1), Mode::active);
  run(Request::none, Request::estop, 1);
  run(Request::none, Request::none, 300);
  writer_->stop();
  ASSERT_EQ(writer_->files(), 1U);

  const auto [first_file, second_file] = files();
  host::RecordedRun first(first_file, {});
  host::RecordedRun second(second_file, {});
  const std::array<host::RecordedRun*, kDevices> both{&first, &second};
  const host::ReplayResult result = host::replay(std::span<host::RecordedRun* const>(both));
  EXPECT_FALSE(result.difference);
  EXPECT_GT(result.first_tick, 0U);
  EXPECT_GT(result.ticks, kFlightTicks / 2);
}

}  // namespace
}  // namespace tactus::firmware
