#include <gtest/gtest.h>

#include <cerrno>
#include <utility>

#include "hal/linux/linux_gpio_chip.h"

namespace tactus::hal {
namespace {

TEST(GpioFailure, TellsWhatACallerMayActUpon) {
  for (const auto& [errno_value, code] :
       {std::pair{ENODEV, ErrorCode::disconnected}, std::pair{EBUSY, ErrorCode::busy},
        std::pair{EINVAL, ErrorCode::not_supported}, std::pair{ENOTTY, ErrorCode::not_found},
        std::pair{EACCES, ErrorCode::not_permitted}, std::pair{ENOMEM, ErrorCode::no_memory},
        std::pair{EIO, ErrorCode::io}}) {
    EXPECT_EQ(gpio_failure(errno_value).error(), (Error{code, errno_value}));
  }
}

TEST(LinuxGpioChip, ThatIsNotThereIsNotFound) {
  EXPECT_EQ(open_gpio_chip("/dev/no-such-chip").error().code, ErrorCode::not_found);
  EXPECT_EQ(open_gpio_chip("no such label").error().code, ErrorCode::not_found);
}

TEST(LinuxGpioChip, IsNoOtherDevice) {
  EXPECT_FALSE(open_gpio_chip("/dev/null"));
}

}  // namespace
}  // namespace tactus::hal
