#include "host_tools/emulators/paddle_wiring.h"

#include <gtest/gtest.h>

#include <vector>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

TEST(PaddleWiring, LinesAreFoundByTheirNames) {
  const std::vector<std::string> texts = {"encoder_a=0", "encoder_b=17",
                                          "emergency_stop=5:active_low", "enable=63:active_low",
                                          "direction=2"};
  const drivers::AxisPins pins = parse_pins(texts);
  ASSERT_TRUE(pins.encoder_a && pins.encoder_b && pins.emergency_stop && pins.enable &&
              pins.direction);
  EXPECT_EQ(pins.encoder_a->offset, 0U);
  EXPECT_EQ(pins.encoder_b->offset, 17U);
  EXPECT_FALSE(pins.encoder_b->active_low);
  EXPECT_EQ(pins.emergency_stop->offset, 5U);
  EXPECT_TRUE(pins.emergency_stop->active_low);
  EXPECT_EQ(pins.enable->offset, 63U);
  EXPECT_TRUE(pins.enable->active_low);
  EXPECT_FALSE(pins.encoder_index || pins.fault || pins.limit_low || pins.limit_high ||
               pins.brake_release || pins.heartbeat);
}

TEST(PaddleWiring, RefusesWhatIsNoLine) {
  for (const char* const text : {"", "encoder_a", "encoder_a=", "encoder_a=x", "encoder_a=-1",
                                 "encoder_a=64", "encoder_c=1", "encoder_a=1:inverted", "=1"}) {
    EXPECT_THROW((void)parse_pins(std::vector<std::string>{text}), InputError) << text;
  }
  EXPECT_THROW((void)parse_pins(std::vector<std::string>{"encoder_a=1", "encoder_b=1"}),
               InputError);
}

}  // namespace
}  // namespace tactus::host
