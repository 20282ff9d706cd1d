#include "host_tools/bake/device/device_bake.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/device_file/homing_words.h"
#include "host_tools/input_error.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPaddle = R"(name = "test"
[mechanism]
kind = "hapkit"
[controller]
rate_hz = 500
[[connection]]
name = "bus"
kind = "can"
interface = "can3"
[[axis]]
name = "drive"
driver = "odrive_can"
connection = "bus"
node_id = 5
max_torque_Nm = 0.25
[[joint]]
name = "paddle"
motor = "drive"
motor_ratio = 17.5
encoder_ratio = 17.5
reference = "known_pose"
reference_rad = 0.1
)";

class DeviceBake : public ::testing::Test {
 protected:
  fs::path write(const std::string& text) const {
    std::ofstream(file) << text;
    return file;
  }
  static std::string with(std::string text, const std::string& old_line, const std::string& line) {
    text.replace(text.find(old_line), old_line.size(), line);
    return text;
  }
  // Returns the error of baking the paddle with one line changed.
  std::string complaint(const std::string& old_line, const std::string& line) const {
    try {
      (void)bake_device(write(with(kPaddle, old_line, line)));
    } catch (const InputError& error) {
      return std::string(error.what()).substr(file.string().size());
    }
    return "no complaint";
  }

  testing::TemporaryFolder folder;
  fs::path file = folder.path() / "device.toml";
};

TEST_F(DeviceBake, SaysWhatTheFileSays) {
  const LoadedDevice device = bake_device(write(kPaddle));
  const firmware::DeviceConfig& config = device.config();
  EXPECT_EQ(config.name, "test");
  EXPECT_EQ(config.controller.rate_hz, 500.0);
  ASSERT_EQ(config.connection_count, 1U);
  ASSERT_EQ(config.axis_count, 1U);
  ASSERT_EQ(config.joint_count, 1U);
  const auto* can = std::get_if<drivers::CanConnection>(&config.connections[0].line);
  ASSERT_NE(can, nullptr);
  EXPECT_EQ(can->interface, "can3");
  const auto* drive = std::get_if<drivers::ODriveConfig>(&config.axes[0].drive);
  ASSERT_NE(drive, nullptr);
  EXPECT_EQ(drive->node_id, 5);
  EXPECT_EQ(drive->max_torque_Nm, 0.25);
  EXPECT_EQ(config.joints[0].transmission.motor_ratio, 17.5);
  EXPECT_EQ(config.joints[0].reference.kind, drivers::ReferenceKind::known_pose);
  EXPECT_EQ(config.joints[0].reference.position, 0.1);
  EXPECT_EQ(config.joints[0].encoder, config.joints[0].motor);
}

TEST_F(DeviceBake, AnExampleSaysWhatHomingAsksOfTheUser) {
  const auto words_for = [](const std::string& device) {
    const LoadedDevice loaded =
        bake_device(testing::in_repository("host_tools/examples/devices/" + device + ".toml"));
    drivers::Words words;
    firmware::add_homing_words(loaded.config(), words);
    return std::string(words.view());
  };
  EXPECT_EQ(words_for("haply"),
            "hold 'left arm' still at 180 deg, hold 'right arm' still at 0 deg");
  EXPECT_EQ(words_for("vesc_paddle"), "let 'paddle' move by itself");
  EXPECT_EQ(words_for("falcon"),
            "home 'top arm' at the device, home 'right arm' at the device, home 'left arm' at the "
            "device");
}

TEST_F(DeviceBake, ImageGivesTheSameDeviceAgain) {
  const LoadedDevice first = bake_device(write(kPaddle));
  const LoadedDevice second(first.image(), "image");
  EXPECT_EQ(second.config().joints[0].name, "paddle");
  EXPECT_EQ(bake_device(write(kPaddle)).image(), first.image());
}

TEST_F(DeviceBake, EveryBitOfTheImageMatters) {
  const LoadedDevice device = bake_device(write(kPaddle));
  for (std::size_t bit = 0; bit < 8 * device.image().size(); bit += 37) {
    std::vector<std::byte> damaged = device.image();
    damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_THROW(LoadedDevice(damaged, "image"), InputError) << "bit " << bit;
  }
}

TEST_F(DeviceBake, EveryTruncatedImageIsRefused) {
  const LoadedDevice device = bake_device(write(kPaddle));
  for (std::size_t size = 0; size < device.image().size(); size += 13) {
    const std::vector<std::byte> cut(device.image().begin(),
                                     device.image().begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(LoadedDevice(cut, "image"), InputError) << size << " bytes";
  }
}

TEST_F(DeviceBake, WrongUnitIsAnswered) {
  EXPECT_EQ(complaint("max_torque_Nm = 0.25", "max_torque_mNm = 250"),
            ":15: [[axis]] 1: unknown key 'max_torque_mNm'; wrong unit, max_torque is in newton "
            "metres; write max_torque_Nm = 0.25");
  EXPECT_NE(complaint("reference_rad = 0.1", "reference_deg = 90").find("reference_rad = 1.57"),
            std::string::npos);
  EXPECT_NE(complaint("max_torque_Nm = 0.25", "max_torque = 0.25").find("max_torque_Nm"),
            std::string::npos);
}

TEST_F(DeviceBake, NearMissIsAnswered) {
  EXPECT_NE(complaint("node_id = 5", "node_di = 5").find("node_id"), std::string::npos);
  EXPECT_NE(complaint("motor_ratio", "motor_ration").find("motor_ratio"), std::string::npos);
}

TEST_F(DeviceBake, ValueOutOfItsRangeNamesTheLineAndTheRange) {
  EXPECT_EQ(complaint("node_id = 5", "node_id = 63"),
            ":14: [[axis]] 1: node_id must lie between 0 and 62");
  EXPECT_EQ(complaint("node_id = 5", "node_id = 5.5"),
            ":14: [[axis]] 1: node_id must be a whole number");
  EXPECT_EQ(complaint("node_id = 5", "node_id = 300"), ":14: [[axis]] 1: node_id is out of range");
  EXPECT_NE(complaint("rate_hz = 500", "rate_hz = 2").find("rate_hz"), std::string::npos);
}

TEST_F(DeviceBake, WatchdogIsALineOfAChip) {
  const std::string top = "name = \"test\"\n";
  const std::string both = "watchdog_chip = \"header\"\nwatchdog_line = \"17 active_low\"\n";
  const LoadedDevice device = bake_device(write(with(kPaddle, top, top + both)));
  EXPECT_EQ(device.config().watchdog_chip, "header");
  ASSERT_TRUE(device.config().watchdog_line.has_value());
  EXPECT_EQ(device.config().watchdog_line->offset, 17U);
  EXPECT_TRUE(device.config().watchdog_line->active_low);
  EXPECT_NE(complaint(top, top + "watchdog_line = \"17\"\n").find("watchdog_chip"),
            std::string::npos);
  EXPECT_NE(complaint(top, top + "watchdog_chip = \"header\"\n").find("watchdog_line"),
            std::string::npos);
}

TEST_F(DeviceBake, WrongTypeIsNamed) {
  EXPECT_EQ(complaint("node_id = 5", "node_id = \"5\""),
            ":14: [[axis]] 1: node_id must be a whole number");
  EXPECT_EQ(complaint("interface = \"can3\"", "interface = 3"),
            ":9: [[connection]] 1: interface must be text, in quotes");
}

TEST_F(DeviceBake, ReferencesMustExist) {
  EXPECT_EQ(complaint("connection = \"bus\"", "connection = \"bos\""),
            ":13: [[axis]] 1: connection must be the name of a [[connection]]");
  EXPECT_EQ(complaint("motor = \"drive\"", "motor = \"drove\""),
            ":18: [[joint]] 1: motor must be the name of an [[axis]]");
  EXPECT_NE(complaint("kind = \"can\"\ninterface = \"can3\"", "kind = \"gpio\"").find("cannot use"),
            std::string::npos);
}

TEST_F(DeviceBake, MechanismWantsItsJoints) {
  EXPECT_NE(complaint("kind = \"hapkit\"", "kind = \"falcon\"").find("more joints"),
            std::string::npos);
  EXPECT_NE(complaint("kind = \"hapkit\"", "kind = \"hapkot\"").find("\"hapkit\""),
            std::string::npos);
}

TEST_F(DeviceBake, UnknownSectionIsNamed) {
  EXPECT_NE(complaint("[controller]", "[controler]").find("unknown section"), std::string::npos);
}

TEST_F(DeviceBake, EveryExampleDeviceBakes) {
  std::size_t baked = 0;
  for (const auto& entry :
       fs::directory_iterator(testing::in_repository("host_tools/examples/devices"))) {
    if (entry.path().extension() == ".toml") {
      EXPECT_TRUE(describes_device(entry.path()));
      EXPECT_NO_THROW((void)bake_device(entry.path())) << entry.path();
      ++baked;
    }
  }
  EXPECT_GE(baked, 7U);
}

TEST_F(DeviceBake, SceneIsNoDevice) {
  EXPECT_FALSE(describes_device(write("[tool]\nradius_m = 0.001\n")));
}

}  // namespace
}  // namespace tactus::host
