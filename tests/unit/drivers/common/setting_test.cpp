#include "drivers/common/setting.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace tactus::drivers {

enum class Colour : std::uint8_t { red, green, blue };
constexpr auto setting_words(Colour /*of*/) {
  return std::to_array<Word<Colour>>(
      {{"red", Colour::red}, {"green", Colour::green}, {"blue", Colour::blue}});
}

namespace {

struct Paint {
  double litres = 2.0;
  std::uint8_t coats = 1;
  Colour colour = Colour::red;
};

constexpr std::array kPaintKeys{
    bind<&Paint::litres>("litres", {}, {1.0, 3.0, "must lie between 1 and 3"}),
    bind<&Paint::coats>("coats"), bind<&Paint::colour>("colour")};

TEST(Settings, ARangeRefusesWhatLiesOutside) {
  Paint paint;
  const auto keys = std::span<const Binding<Paint>>(kPaintKeys);
  EXPECT_TRUE(check_ranges(paint, keys));
  for (const double wrong : {0.99, 3.01, std::numeric_limits<double>::quiet_NaN()}) {
    paint.litres = wrong;
    const auto refused = check_ranges(paint, keys);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "litres");
    EXPECT_EQ(refused.error().rule, "must lie between 1 and 3");
  }
}

TEST(Settings, AnEnumerationHasItsWords) {
  Paint paint;
  EXPECT_EQ(kPaintKeys[2].assign(paint, {.type = SettingType::text, .text = "blue"}), "");
  EXPECT_EQ(paint.colour, Colour::blue);
  EXPECT_EQ(kPaintKeys[2].assign(paint, {.type = SettingType::text, .text = "pink"}),
            R"(must be "red", "green" or "blue")");
}

TEST(Settings, ANumberFitsItsField) {
  Paint paint;
  const auto assign = [&paint](double value) {
    return kPaintKeys[1].assign(paint, {.numbers = std::span(&value, 1)});
  };
  EXPECT_EQ(assign(2.0), "");
  EXPECT_EQ(paint.coats, 2);
  EXPECT_EQ(assign(256.0), "is out of range");
  EXPECT_EQ(assign(1.5), "must be a whole number");
}

}  // namespace
}  // namespace tactus::drivers
