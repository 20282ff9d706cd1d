#include "host_tools/deploy/package_choice.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "host_tools/input_error.h"
#include "tests/support/folder_test.h"

namespace tactus::host {
namespace {

class PackageChoice : public FolderTest {
 protected:
  // Writes a file that is so many hours old.
  void write(const std::string& name, int hours) const {
    std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
    std::ofstream(file(name)) << name;
    std::filesystem::last_write_time(
        file(name), std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
  }
};

TEST_F(PackageChoice, TakesTheNewestBuildForTheProcessor) {
  write("tactusd_0.9.0_arm64.deb", 5);
  write("tactus_0.9.0_arm64.deb", 1);
  write("tactusd_0.10.0_arm64.deb", 2);
  write("tactus_0.10.0_arm64.deb", 6);
  write("tactusd_0.11.0_amd64.deb", 0);
  write("tactus_0.11.0_amd64.deb", 0);
  const BoardPackages packages = choose_packages(folder(), "arm64");
  EXPECT_EQ(packages.tactusd, file("tactusd_0.10.0_arm64.deb"));
  EXPECT_EQ(packages.tactus, file("tactus_0.10.0_arm64.deb"));
}

TEST_F(PackageChoice, LooksIntoTheFolderOfTheProcessorFirst) {
  write("tactusd_0.2.0_armhf.deb", 0);
  write("tactus_0.2.0_armhf.deb", 0);
  write("armhf/tactusd_0.1.0_armhf.deb", 9);
  write("armhf/tactus_0.1.0_armhf.deb", 9);
  EXPECT_EQ(choose_packages(folder(), "armhf").tactusd, file("armhf/tactusd_0.1.0_armhf.deb"));
}

TEST_F(PackageChoice, NamesTheCommandForAFolderThatIsNotThere) {
  try {
    choose_packages(file("nowhere"), "arm64");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("toolchains/debian-packages.sh arm64"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace tactus::host
