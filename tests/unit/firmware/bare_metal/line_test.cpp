#include "firmware/bare_metal/line.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace tactus::firmware {
namespace {

constexpr std::size_t kLineRoom = 160;

TEST(BareMetalLine, HasWordsAndNumbersInTheOrderInWhichTheyWereAdded) {
  Line line;
  line.add("tick").add(std::uint64_t{4000}).add(" hash").add_hex(0xab0c).add(" mode ").add("fault");
  EXPECT_EQ(line.text(), "tick 4000 hash 000000000000ab0c mode fault");
}

TEST(BareMetalLine, HasEveryDigitOfTheSmallestAndTheLargestNumber) {
  constexpr auto kLargest = std::numeric_limits<std::uint64_t>::max();
  Line line;
  line.add(std::uint64_t{0}).add_hex(0).add(kLargest).add_hex(kLargest);
  EXPECT_EQ(line.text(), " 0 0000000000000000 18446744073709551615 ffffffffffffffff");
}

TEST(BareMetalLine, LeavesOutWhatDoesNotFit) {
  const std::string filling(kLineRoom - 2, 'x');
  Line line;
  line.add(filling).add("abc");
  EXPECT_EQ(line.text(), filling + "ab");
  line.add("d").add(std::uint64_t{7}).add_hex(7);
  EXPECT_EQ(line.text(), filling + "ab");
}

}  // namespace
}  // namespace tactus::firmware
