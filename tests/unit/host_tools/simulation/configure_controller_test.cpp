#include "host_tools/configure_controller.h"

#include <gtest/gtest.h>

#include <memory>

#include "firmware/configuration/controller_config.h"

namespace tactus::host {
namespace {

TEST(ConfigureController, TellsWhichFieldIsAtFaultAndWhatItMayBe) {
  const auto controller = std::make_unique<firmware::Controller>();
  firmware::ControllerConfig config = firmware::cartesian_config();
  EXPECT_NO_THROW(configure(*controller, config));
  config.safety.max_force_N = -1.0;
  try {
    configure(*controller, config);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "the controller refuses the configuration: safety.max_force_N is -1, not in 0 to 50");
  }
}

}  // namespace
}  // namespace tactus::host
