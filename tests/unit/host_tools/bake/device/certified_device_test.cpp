// A device's certificate on its way into the image: it holds for the settings that it was made for.
#include <gtest/gtest.h>

#include <algorithm>

#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/files/atomic_file.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

class CertifiedDevice : public ::testing::Test {
 protected:
  // Writes a device and the certificate that tactus certify leaves beside its file.
  CertifiedDevice() {
    (void)folder.write(
        "arm.toml",
        read_file(testing::in_repository("host_tools/examples/devices/odrive_arm.toml")));
    firmware::StiffnessCertificate certificate;
    certificate.count = 2;
    certificate.points[0] = {.damping_Ns_per_m = 0.0, .stiffness_N_per_m = 900.0};
    certificate.points[1] = {.damping_Ns_per_m = 2.0, .stiffness_N_per_m = 1500.0};
    write_certificate(certificate_path(file), certificate, "test",
                      bake_device(file).settings_checksum());
  }

  void replace(const std::string& old_text, const std::string& text) const {
    std::string all = read_file(file);
    const std::size_t at = all.find(old_text);
    ASSERT_NE(at, std::string::npos) << old_text;
    (void)folder.write("arm.toml", all.replace(at, old_text.size(), text));
  }

  testing::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "arm.toml";
};

TEST_F(CertifiedDevice, HasTheLimitsOfItsCertificate) {
  const LoadedDevice device = bake_device(file);
  const firmware::StiffnessCertificate& limits = device.config().controller.certificate;
  ASSERT_EQ(limits.count, 2U);
  EXPECT_EQ(limits.points[1].damping_Ns_per_m, 2.0);
  EXPECT_EQ(limits.points[1].stiffness_N_per_m, 1500.0);
  EXPECT_EQ(device.config().certification.measured_with, "test");
}

TEST_F(CertifiedDevice, LosesThemOnceAContactMayBehaveOtherwise) {
  for (const auto& [setting, other] : {std::pair{"rate_hz = 1000", "rate_hz = 900"},
                                       std::pair{"max_force_N = 5", "max_force_N = 6"},
                                       std::pair{"max_torque_Nm = 0.15", "max_torque_Nm = 0.14"}}) {
    replace(setting, other);
    const LoadedDevice device = bake_device(file);
    EXPECT_FALSE(device.config().controller.certificate.exists()) << other;
    EXPECT_TRUE(std::ranges::any_of(device.warnings(), [](const std::string& warning) {
      return warning.find("certificate") != std::string::npos;
    })) << other;
    replace(other, setting);
  }
  EXPECT_TRUE(bake_device(file).config().controller.certificate.exists());
}

TEST_F(CertifiedDevice, KeepsThemByAnotherNameOnAnotherInterface) {
  replace("interface = \"can0\"", "interface = \"can1\"");
  replace("name = \"WoodenHaptics on ODrive\"", "name = \"mine\"");
  EXPECT_TRUE(bake_device(file).config().controller.certificate.exists());
}

}  // namespace
}  // namespace tactus::host
