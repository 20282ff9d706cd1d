#include "tests/mutation/planted_faults.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace tactus::mutation {
namespace {

constexpr const char* kList =
    "# a comment\n"
    "[clamp is twice as wide]\n"
    "file  a.cpp\n"
    "from  x > limit\n"
    "to    x > 2 * limit\n"
    "tests a_test Clamp.*\n"
    "\n"
    "[nothing is cleared]\n"
    "file  a.cpp\n"
    "from  clear();\n"
    "to\n"
    "tests a_test Clear.*:Other.*\n";

TEST(PlantedFaults, StandBehindSwitchesAsExpressionOrStatement) {
  const auto faults = read_faults("list", kList);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[1].filter, "Clear.*:Other.*");
  EXPECT_EQ(with_faults("list", "if (x > limit) { clear(); }", faults),
            "#include \"planted_switch.h\"\n#line 1\n"
            "if ((::tactus::mutation::is_on(1) ? (x > 2 * limit) : (x > limit))) { "
            "if (::tactus::mutation::is_on(2)) {   } else { clear(); } }");
}

std::string why_refused(const char* source, const char* list = kList) {
  try {
    with_faults("list", source, read_faults("list", list));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(PlantedFaults, WhosePlaceIsGoneOrNotTheOnlyOneAreRefused) {
  EXPECT_NE(why_refused("clear();").find("list:2: the text of 'from'"), std::string::npos);
  EXPECT_NE(why_refused("x > limit, x > limit; clear();").find("list:2:"), std::string::npos);
  EXPECT_NE(why_refused("", "file a.cpp\n").find("list:1: a fault begins"), std::string::npos);
  EXPECT_NE(why_refused("", "[a]\nfile a.cpp\n").find("list:1: a fault needs"), std::string::npos);
  EXPECT_NE(why_refused("", "[a]\nwho knows\n").find("list:2: a line begins"), std::string::npos);
}

}  // namespace
}  // namespace tactus::mutation
