// The result of commissioning on its way into a device's image, and what it lets the controller do.
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/device_file/device_certificate.h"
#include "firmware/device_file/device_commissioning.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/files/atomic_file.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;

class CommissionedDevice : public ::testing::Test {
 protected:
  CommissionedDevice() {
    device_text(read_file(testing::in_repository("host_tools/examples/devices/odrive_arm.toml")));
  }

  void device_text(const std::string& text) { (void)folder.write("arm.toml", text); }

  // Writes the file that tactus commission leaves beside the device's current file.
  void commission(bool passed) {
    const LoadedDevice device = bake_device(file);
    (void)folder.write(
        "arm.commissioning.toml",
        "[commissioning]\npassed = " + std::string(passed ? "true" : "false") +
            "\ninertia = [1.0]\nmoving_mass_kg = 0.2\nfriction = [0.1]\ndelay_ticks = "
            "[1]\nmeasured_with = \"test\"\n"
            "settings = \"" +
            std::string(firmware::checksum_text(device.all_settings_checksum()).view()) + "\"\n");
  }

  std::string refusal() const {
    return std::string(firmware::commissioning_refusal(bake_device(file).config().commissioning));
  }

  void replace(const std::string& old_text, const std::string& text) {
    std::string all = read_file(file);
    const std::size_t at = all.find(old_text);
    ASSERT_NE(at, std::string::npos) << old_text;
    device_text(all.replace(at, old_text.size(), text));
  }

  testing::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "arm.toml";
};

TEST_F(CommissionedDevice, MayBeEnabledOnceItHasPassed) {
  EXPECT_TRUE(contains(refusal(), "was not commissioned"));
  commission(true);
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(bake_device(file).config().commissioning.measured_with, "test");
  EXPECT_EQ(bake_device(file).config().controller.safety.moving_mass_kg, 0.2);
}

TEST_F(CommissionedDevice, MayNotIfItFailed) {
  commission(false);
  EXPECT_TRUE(contains(refusal(), "failed its commissioning"));
}

TEST_F(CommissionedDevice, MayNotOnceAnythingWasChanged) {
  commission(true);
  replace("interface = \"can0\"", "interface = \"can1\"");
  EXPECT_TRUE(contains(refusal(), "was not commissioned"));
  const auto warnings = bake_device(file).warnings();
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& warning) {
    return warning.find("not taken in") != std::string::npos;
  }));
  replace("interface = \"can1\"", "interface = \"can0\"");
  EXPECT_EQ(refusal(), "");
}

TEST_F(CommissionedDevice, DoesNotLoseItByAnotherName) {
  commission(true);
  replace("name = \"WoodenHaptics on ODrive\"", "name = \"mine\"");
  EXPECT_EQ(refusal(), "");
}

TEST_F(CommissionedDevice, IsNotMadeByHandInTheDevicesOwnFile) {
  replace("[mechanism]", "[commissioning]\npassed = true\n[mechanism]");
  EXPECT_TRUE(contains(testing::input_error([&] { (void)bake_device(file); }),
                       "stands in a file of its own, which tactus commission writes"));
}

TEST_F(CommissionedDevice, NeedsEveryKeyOfItsFile) {
  (void)folder.write("arm.commissioning.toml", "[commissioning]\npassed = true\n");
  EXPECT_TRUE(contains(testing::input_error([&] { (void)bake_device(file); }),
                       "run tactus commission again"));
}

}  // namespace
}  // namespace tactus::host
