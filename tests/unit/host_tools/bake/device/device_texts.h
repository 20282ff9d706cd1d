// Texts of devices for tests of what baking refuses, and a fixture that bakes them.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/input_error.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {

inline std::string replaced(std::string text, const std::string& old_text,
                            const std::string& new_text) {
  const std::size_t at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return text.replace(at, old_text.size(), new_text);
}

inline std::string axis(const std::string& name, const std::string& driver, const std::string& keys,
                        const std::string& connection = "bus") {
  return "[[axis]]\nname = \"" + name + "\"\ndriver = \"" + driver + "\"\nconnection = \"" +
         connection + "\"\n" + keys;
}

inline std::string joint(const std::string& name, const std::string& motor,
                         const std::string& keys) {
  return "[[joint]]\nname = \"" + name + "\"\nmotor = \"" + motor + "\"\n" + keys;
}

inline std::string device(const std::string& mechanism, double rate_hz) {
  return "[mechanism]\nkind = \"" + mechanism +
         "\"\n[controller]\nrate_hz = " + std::to_string(rate_hz) + "\n";
}

inline constexpr const char* kBus =
    "[[connection]]\nname = \"bus\"\nkind = \"can\"\ninterface = \"can0\"\n";
inline constexpr const char* kKnownPose = "reference = \"known_pose\"\n";

inline const std::string kODrive = "max_torque_Nm = 0.2\n";

// A paddle of +-45 degrees on one ODrive, with these keys at the axis and the joint.
inline std::string paddle(const std::string& axis_keys, const std::string& joint_keys,
                          double rate_hz = 1000.0) {
  return device("hapkit", rate_hz) + kBus + axis("drive", "odrive_can", kODrive + axis_keys) +
         joint("paddle", "drive", joint_keys);
}

// Three joints, each on an axis with these words.
inline std::string arm(const std::string& first, const std::string& second,
                       const std::string& third, double rate_hz = 500.0) {
  return device("woodenhaptics", rate_hz) + kBus + first + second + third +
         joint("azimuth", "a", kKnownPose) + joint("upper arm", "b", kKnownPose) +
         joint("forearm", "c", kKnownPose);
}

inline std::string odrive(const std::string& name, int node) {
  return axis(name, "odrive_can", kODrive + "node_id = " + std::to_string(node) + "\n");
}

inline std::string cia402(const std::string& name, int node, bool leads,
                          const std::string& period_s) {
  return axis(name, "cia402_can",
              "max_torque_Nm = 0.2\nnode = " + std::to_string(node) +
                  "\nleads_bus = " + (leads ? "true" : "false") + "\nperiod_s = " + period_s +
                  "\nlost_after_s = 0.01\n");
}

inline constexpr const char* kGpio =
    "[[connection]]\nname = \"board\"\nkind = \"gpio\"\nchip = \"header\"\n"
    "pwm_folder = \"/sys/class/pwm/pwmchip0\"\n";

inline const std::string kBridge =
    "encoder_a = \"0\"\nencoder_b = \"1\"\ndirection = \"2\"\ncounts_per_turn = 1000\n"
    "max_speed_rad_per_s = 200\nfull_duty_torque_Nm = 0.03\nmax_torque_Nm = 0.03\n";

inline std::string bridge(const std::string& axis_keys,
                          const std::string& joint_keys = kKnownPose) {
  return device("hapkit", 1000.0) + kGpio +
         axis("motor", "gpio_axis", kBridge + axis_keys, "board") +
         joint("paddle", "motor", joint_keys);
}

inline std::string haply(const std::string& connection_keys, const std::string& joint_keys,
                         int second_number = 1) {
  return device("haply_pantograph", 1000.0) +
         "[[connection]]\nname = \"usb\"\nkind = \"haply_serial\"\nport = \"/dev/ttyACM0\"\n" +
         connection_keys + axis("m1", "haply_serial", "number = 0\n", "usb") +
         axis("m2", "haply_serial", "number = " + std::to_string(second_number) + "\n", "usb") +
         joint("left", "m1", joint_keys) + joint("right", "m2", joint_keys);
}

class DeviceRefusals : public ::testing::Test {
 protected:
  // Baking's words about the file, or that it bakes.
  std::string complaint(const std::string& text) const {
    const auto file = folder.write("device.toml", text);
    try {
      (void)bake_device(file);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(file.string().size());
    }
    return "bakes";
  }
  void expect_words(const std::string& text, std::initializer_list<const char*> words) const {
    const std::string said = complaint(text);
    for (const char* word : words) {
      EXPECT_TRUE(said.contains(word)) << "'" << word << "' is not in: " << said;
    }
  }
  void expect_bakes(const std::string& text) const { EXPECT_EQ(complaint(text), "bakes"); }

  testing::TemporaryFolder folder;
};

}  // namespace tactus::host
