// The registrations of all drivers.
#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "drivers/any_drive.h"

namespace tactus::drivers {
namespace {

template <class Action>
void for_each_driver(Action action) {
  std::apply([&](const auto&... drivers) { (action(drivers), ...); }, kRegisteredDrivers);
}

TEST(Registrations, NamesAndKeysDiffer) {
  std::set<std::string_view> names;
  for_each_driver([&](const auto& driver) {
    EXPECT_TRUE(names.insert(driver.name).second) << driver.name;
    std::set<std::string_view> keys;
    for (const auto& binding : driver.keys()) {
      EXPECT_TRUE(keys.insert(binding.key).second) << driver.name << ": " << binding.key;
      EXPECT_TRUE(binding.key.ends_with(binding.unit)) << driver.name << ": " << binding.key;
    }
  });
}

TEST(Registrations, ADriverIsChosenByItsName) {
  std::size_t place = 0;
  for_each_driver([&](const auto& driver) {
    AnyDrive drive;
    EXPECT_TRUE(choose_drive(drive, driver.name));
    EXPECT_EQ(drive.index(), place);
    visit_drive(drive, [&](const auto& found, const auto& /*settings*/) {
      EXPECT_EQ(found.name, driver.name);
    });
    ++place;
  });
  AnyDrive drive;
  EXPECT_FALSE(choose_drive(drive, "no_driver"));
}

TEST(Registrations, TheRuleNamesEveryDriver) {
  for_each_driver([](const auto& driver) {
    EXPECT_TRUE(kDriverRule.view().contains("\"" + std::string(driver.name) + "\""));
  });
  EXPECT_EQ(kConnectionRule.view(), R"(must be "can", "falcon_usb", "haply_serial" or "gpio")");
}

TEST(Registrations, ADriveOnCanClaimsIdentifiersAndLoadsItsBus) {
  for_each_driver([]<class Driver>(const Driver& driver) {
    if constexpr (!std::is_void_v<typename Driver::Drive>) {
      CanIdentifiers identifiers;
      driver.can.claim({}, identifiers);
      EXPECT_FALSE(identifiers.all().empty()) << driver.name;
      const double slow = driver.can.load({}, CanConnection{}, 500.0);
      EXPECT_GT(slow, 0.0) << driver.name;
      EXPECT_GT(driver.can.load({}, CanConnection{}, 1000.0), slow) << driver.name;
      EXPECT_TRUE(driver.can.have_same_number({}, {})) << driver.name;
    }
  });
}

}  // namespace
}  // namespace tactus::drivers
