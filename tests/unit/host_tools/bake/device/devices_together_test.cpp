// Devices of one controller that do or do not work beside each other.
#include "firmware/device_file/together_checks.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/device_file/bus_load.h"
#include "tests/unit/host_tools/bake/device/device_texts.h"

namespace tactus::host {
namespace {

using firmware::DeviceConfig;

constexpr double kRate_Hz = 200.0;

// An ODrive that sends its position when asked, so that a bus has room for several arms.
std::string asked_odrive(const std::string& name, int node) {
  return odrive(name, node) + "estimates = \"requested\"\n";
}

// Three such drives from this node on, on can0.
std::string odrive_arm(int first_node) {
  return "name = \"arm from " + std::to_string(first_node) + "\"\n" +
         arm(asked_odrive("a", first_node), asked_odrive("b", first_node + 1),
             asked_odrive("c", first_node + 2), kRate_Hz);
}

std::string falcon(const std::string& connection_keys) {
  std::string text = device("falcon", 1000.0) +
                     "[[connection]]\nname = \"usb\"\nkind = \"falcon_usb\"\n"
                     "unproven_watchdog = true\n" +
                     connection_keys;
  for (int i = 0; i < 3; ++i) {
    const std::string name = "m" + std::to_string(i);
    text += axis(name, "falcon_usb", "number = " + std::to_string(i) + "\n", "usb");
  }
  for (int i = 0; i < 3; ++i) {
    text += joint("j" + std::to_string(i), "m" + std::to_string(i), "reference = \"board\"\n");
  }
  return text;
}

class DevicesTogether : public ::testing::Test {
 protected:
  // Returns "2 interface would be ...": the number of the refused device, the key and the rule; or
  // "fit".
  std::string verdict(const std::vector<std::string>& texts) const {
    std::vector<LoadedDevice> devices;
    devices.reserve(texts.size());
    for (const std::string& text : texts) {
      devices.push_back(bake_device(folder.write("device.toml", text)));
    }
    std::vector<const DeviceConfig*> configs;
    configs.reserve(devices.size());
    for (const LoadedDevice& device : devices) {
      configs.push_back(&device.config());
    }
    firmware::Words words;
    const auto fit = firmware::check_together(configs, words);
    if (fit) {
      return "fit";
    }
    return std::to_string(fit.error().device + 1) + " " + std::string(fit.error().refusal.key) +
           " " + std::string(fit.error().refusal.rule);
  }
  void expect_words(const std::vector<std::string>& texts,
                    std::initializer_list<std::string_view> words) const {
    const std::string said = verdict(texts);
    for (const std::string_view word : words) {
      EXPECT_TRUE(said.contains(word)) << "'" << word << "' is not in: " << said;
    }
  }

  testing::TemporaryFolder folder;
};

TEST_F(DevicesTogether, ShareABusIfTheirDrivesHaveNumbersOfTheirOwn) {
  EXPECT_EQ(verdict({odrive_arm(0)}), "fit");
  EXPECT_EQ(verdict({odrive_arm(0), odrive_arm(3)}), "fit");
  expect_words({odrive_arm(0), odrive_arm(2)},
               {R"(2 node_id is also that of axis "c" of device 1 ("arm from 0"))"});
  expect_words({odrive_arm(0), odrive_arm(3), odrive_arm(5)},
               {"3 node_id is also that of axis \"c\" of device 2"});
  // Another interface has another bus.
  EXPECT_EQ(verdict({odrive_arm(0), replaced(odrive_arm(0), "\"can0\"", "\"can1\"")}), "fit");
}

TEST_F(DevicesTogether, DoNotShareIdentifiersOnABus) {
  const std::string leader =
      arm(cia402("a", 1, true, "0.005"), asked_odrive("b", 30), asked_odrive("c", 24), kRate_Hz);
  expect_words({leader, odrive_arm(4)},
               {"2 node_id gives it the CAN identifier 0x80", "axis \"a\" of device 1"});
  EXPECT_EQ(verdict({leader, odrive_arm(26)}), "fit");
  // A bus has one leader.
  const std::string other =
      arm(cia402("a", 2, true, "0.005"), asked_odrive("b", 28), asked_odrive("c", 27), kRate_Hz);
  expect_words({leader, other}, {"2 interface cannot be shared with the devices before: "});
}

TEST_F(DevicesTogether, AgreeOnTheRateOfTheirBus) {
  const std::string slow = replaced(odrive_arm(3), "interface = \"can0\"\n",
                                    "interface = \"can0\"\nbit_rate = 500000\n");
  expect_words({odrive_arm(0), slow}, {"2 bit_rate is not that of connection \"bus\" of device 1"});
}

// Each bus alone has the share of one device; the sum decides.
TEST_F(DevicesTogether, FitOnTheirBusWithAllTheirFrames) {
  const LoadedDevice one = bake_device(folder.write("one.toml", odrive_arm(0)));
  const double load = firmware::bus_load(one.config(), 0);
  ASSERT_LT(3.0 * load, firmware::kMaxBusLoad) << "three arms on one bus";
  std::vector<std::string> devices;
  while (static_cast<double>(devices.size() + 1) * load <= firmware::kMaxBusLoad) {
    devices.push_back(odrive_arm(3 * static_cast<int>(devices.size())));
    EXPECT_EQ(verdict(devices), "fit");
  }
  devices.push_back(odrive_arm(3 * static_cast<int>(devices.size())));
  expect_words(devices, {std::to_string(devices.size()) + " interface would be ",
                         "full with the frames of all devices"});
}

TEST_F(DevicesTogether, HavePortsAndBoardsOfTheirOwn) {
  const std::string board = haply("unproven_watchdog = true\n", kKnownPose);
  expect_words({board, board}, {"2 port is also that of connection \"usb\" of device 1"});
  EXPECT_EQ(verdict({board, replaced(board, "ttyACM0", "ttyACM1")}), "fit");
}

TEST_F(DevicesTogether, FalconsAreToldApartByTheirSerialNumbers) {
  const std::string left = falcon("serial = \"A1\"\n");
  EXPECT_EQ(verdict({left, falcon("serial = \"B2\"\n")}), "fit");
  for (const std::string& other : {left, falcon("")}) {
    expect_words({left, other}, {"2 serial is also that of", "serial number of each"});
    expect_words({other, left}, {"2 serial is also that of"});
  }
}

}  // namespace
}  // namespace tactus::host
