// A folder of ordinary files laid out as the kernel lays out a device, gone at the end of the test.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tactus::hal {

class SysfsFolder {
 public:
  SysfsFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tactus_sysfs_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  SysfsFolder(const SysfsFolder&) = delete;
  SysfsFolder& operator=(const SysfsFolder&) = delete;
  ~SysfsFolder() { std::filesystem::remove_all(path_); }

  [[nodiscard]] std::string root() const { return path_.string(); }

  // Writes the file of an attribute that reads `value`.
  void set(const std::string& name, const std::string& value) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name) << value << '\n';
  }
  // Returns the first line of an attribute's file.
  [[nodiscard]] std::string get(const std::string& name) const {
    std::ifstream file(path_ / name);
    std::string line;
    EXPECT_TRUE(std::getline(file, line)) << name;
    return line;
  }
  void remove(const std::string& name) const { std::filesystem::remove_all(path_ / name); }

 private:
  std::filesystem::path path_;
};

}  // namespace tactus::hal
