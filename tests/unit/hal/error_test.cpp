#include "hal/error.h"

#include <gtest/gtest.h>

#include <set>

namespace tactus::hal {
namespace {

TEST(Error, EveryCodeHasWordsOfItsOwn) {
  std::set<std::string_view> seen;
  for (int i = 0; i <= static_cast<int>(ErrorCode::no_memory); ++i) {
    const std::string_view text = words(static_cast<ErrorCode>(i));
    EXPECT_FALSE(text.empty());
    EXPECT_NE(text, "unknown error") << i;
    EXPECT_TRUE(seen.insert(text).second) << text;
  }
  EXPECT_EQ(words(static_cast<ErrorCode>(200)), "unknown error");
}

TEST(Error, FailureKeepsTheErrno) {
  const Result<int> result = failure(ErrorCode::io, 5);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), (Error{ErrorCode::io, 5}));
}

}  // namespace
}  // namespace tactus::hal
