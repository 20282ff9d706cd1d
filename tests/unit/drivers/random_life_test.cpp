// The properties that the fuzz targets look for, on random bytes: quick, and in every build.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/fuzz/cia402_can_run.h"
#include "tests/fuzz/moteus_canfd_run.h"
#include "tests/fuzz/odrive_can_run.h"
#include "tests/fuzz/vesc_can_run.h"
#include "tests/support/share.h"
#include "tests/unit/hal/random.h"

namespace tactus::fuzz {
namespace {

// `Life` ends the program with the property's name if one breaks.
template <class Life>
void live_often(std::uint64_t seed) {
  hal::Random random(seed);
  const int lives = testing::share_of(3000);
  for (int life = 0; life < lives; ++life) {
    std::vector<std::uint8_t> bytes(random.below(2000) + 1);
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(random.bits());
    }
    Life{}.run({bytes.data(), bytes.size()});
  }
}

TEST(RandomLife, HealthyDriveComesUp) {
  EXPECT_TRUE(ODriveLife{}.comes_up(0));  // firmware 0.5
  EXPECT_TRUE(ODriveLife{}.comes_up(2));  // firmware 0.6
  EXPECT_TRUE(MoteusLife{}.comes_up());
  EXPECT_TRUE(Cia402Life{}.comes_up());
  EXPECT_TRUE(VescLife{}.comes_up());
}

TEST(RandomLife, ODriveNeverReportsAJumpNorCommandsBeyondItsLimit) {
  live_often<ODriveLife>(5);
}

TEST(RandomLife, MoteusNeverReportsAJumpNorCommandsBeyondItsLimit) {
  live_often<MoteusLife>(6);
}

TEST(RandomLife, Cia402DriveNeverReportsAJumpNorCommandsBeyondItsLimit) {
  live_often<Cia402Life>(7);
}

TEST(RandomLife, VescNeverReportsAJumpNorCommandsBeyondItsLimit) {
  live_often<VescLife>(8);
}

}  // namespace
}  // namespace tactus::fuzz
