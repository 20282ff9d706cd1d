// A folder of its own for each test that writes files or sockets.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace tactus {

class FolderTest : public ::testing::Test {
 public:
  FolderTest(const FolderTest&) = delete;
  FolderTest& operator=(const FolderTest&) = delete;
  ~FolderTest() override { std::filesystem::remove_all(folder_); }

 protected:
  // Short: the name of a socket has room for 107 characters.
  FolderTest() {
    std::string name = "/tmp/tactus-XXXXXX";
    folder_ = mkdtemp(name.data());
  }

  [[nodiscard]] const char* folder() const { return folder_.c_str(); }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace tactus
