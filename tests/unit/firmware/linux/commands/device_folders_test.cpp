// The folders of devices and the links by their names, in a folder of this test.
#include "firmware/linux/commands/device_folders.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/folder_test.h"

namespace tactus::firmware {
namespace {

namespace fs = std::filesystem;

using Links = std::map<std::string, std::string>;

class DeviceFolders : public FolderTest {
 protected:
  // Returns the links of the folder of names with their targets.
  [[nodiscard]] Links links() const {
    Links found;
    for (const auto& entry : fs::directory_iterator(file(kNamesFolder))) {
      found[entry.path().filename().string()] = fs::read_symlink(entry.path()).string();
    }
    return found;
  }
};

TEST_F(DeviceFolders, AreLinkedByTheNamesOfTheirDevices) {
  fs::create_directory(file("2"));
  ASSERT_EQ(link_device_names(folder(), std::to_array<std::string_view>({"left", "right"})), 0);
  EXPECT_EQ(links(), (Links{{"left", ".."}, {"right", "../2"}}));
  EXPECT_TRUE(fs::equivalent(file(kNamesFolder) + "/left", folder()));
  EXPECT_TRUE(fs::equivalent(file(kNamesFolder) + "/right", file("2")));
}

TEST_F(DeviceFolders, HaveNoLinksOfAnEarlierRun) {
  ASSERT_EQ(link_device_names(folder(), std::to_array<std::string_view>({"left", "right"})), 0);
  ASSERT_EQ(link_device_names(folder(), std::to_array<std::string_view>({"right", "pen"})), 0);
  EXPECT_EQ(links(), (Links{{"right", ".."}, {"pen", "../2"}}));
}

TEST_F(DeviceFolders, AreNotLinkedByNamesThatDoNotTellThemApart) {
  const std::string longest(255, 'a');
  const std::string too_long(256, 'a');
  const std::vector<std::string_view> names{"arm", "arm", "", "a/b", ".", "..", longest, too_long};
  ASSERT_EQ(link_device_names(folder(), names), 0);
  EXPECT_EQ(links(), (Links{{longest, "../7"}}));
}

TEST_F(DeviceFolders, HaveTheRightsOfTheControllersFolder) {
  fs::permissions(folder(), fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec);
  ASSERT_EQ(link_device_names(folder(), std::to_array<std::string_view>({"left"})), 0);
  EXPECT_EQ(fs::status(file(kNamesFolder)).permissions(), fs::status(folder()).permissions());
}

TEST_F(DeviceFolders, SayWhyTheyCannotBeMade) {
  const std::string none = file("none");
  EXPECT_EQ(link_device_names(none.c_str(), {}), ENOENT);
  std::ofstream(file(kNamesFolder)) << "a file";
  EXPECT_EQ(link_device_names(folder(), {}), ENOTDIR);
}

TEST(DeviceName, IsThatOfItsImage) {
  EXPECT_EQ(device_name_of("left.tactus"), "left");
  EXPECT_EQ(device_name_of("/etc/tactus/left.arm.tactus"), "left.arm");
  EXPECT_EQ(device_name_of("./left"), "left");
  EXPECT_EQ(device_name_of("etc.d/left"), "left");
}

}  // namespace
}  // namespace tactus::firmware
