// A folder of its own for each test that writes files or sockets.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace tactus {

class FolderTest : public testing::Test {
 protected:
  // Short: the name of a socket has room for 107 characters.
  FolderTest() {
    std::string name = "/tmp/tactus-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~FolderTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string file(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace tactus
