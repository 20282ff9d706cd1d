#include "hal/linux/exclusive_claim.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <string>

namespace tactus::hal {
namespace {

std::string own_name() {
  return "test/" + std::to_string(::getpid());
}

TEST(ExclusiveClaim, IsOneProgramsAndNamesIt) {
  ExclusiveClaim first;
  EXPECT_TRUE(first.take(own_name()).is_held);
  ExclusiveClaim second;
  const ClaimOutcome refused = second.take(own_name());
  EXPECT_FALSE(refused.is_held);
  EXPECT_EQ(refused.errno_value, EADDRINUSE);
  EXPECT_EQ(refused.holder, ::getpid());
}

TEST(ExclusiveClaim, OfAnotherNameIsFree) {
  ExclusiveClaim first;
  ExclusiveClaim second;
  EXPECT_TRUE(first.take(own_name()).is_held);
  EXPECT_TRUE(second.take(own_name() + "/other").is_held);
}

TEST(ExclusiveClaim, VanishesWithItsHolder) {
  std::optional<ExclusiveClaim> first(std::in_place);
  EXPECT_TRUE(first->take(own_name()).is_held);
  first.reset();
  ExclusiveClaim second;
  EXPECT_TRUE(second.take(own_name()).is_held);
}

TEST(ExclusiveClaim, VanishesWithAProgramThatIsKilled) {
  const std::string name = own_name() + "/killed";
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ExclusiveClaim claim;
    const char held = claim.take(name).is_held ? '1' : '0';
    [[maybe_unused]] const auto written = ::write(ready[1], &held, 1);
    ::pause();
    ::_exit(0);
  }
  char held = '0';
  ASSERT_EQ(::read(ready[0], &held, 1), 1);
  ASSERT_EQ(held, '1');
  ExclusiveClaim mine;
  EXPECT_EQ(mine.take(name).holder, child);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(mine.take(name).is_held);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(ExclusiveClaim, RefusesANameThatIsTooLong) {
  ExclusiveClaim claim;
  EXPECT_EQ(claim.take(std::string(101, 'x')).errno_value, ENAMETOOLONG);
  EXPECT_TRUE(claim.take(std::string(90, 'x') + own_name().substr(0, 10)).is_held);
}

}  // namespace
}  // namespace tactus::hal
