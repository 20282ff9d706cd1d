#include "host_tools/files/private_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

TEST(PrivateFolderTest, IsTheOwnersAloneAndGoesWithItsContent) {
  std::filesystem::path path;
  {
    const PrivateFolder folder;
    path = folder.path();
    std::ofstream(path / "file") << "content";
    EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms::owner_all);
    const PrivateFolder inner(path);
    EXPECT_EQ(inner.path().parent_path(), path);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(PrivateFolderTest, SaysWhatIsWrongWithThePlace) {
  EXPECT_THROW(PrivateFolder("/no/such/place"), InputError);
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("TMPDIR", "/no/such/place", 1);
  EXPECT_THROW(PrivateFolder{}, InputError);
  if (before == nullptr) {
    ::unsetenv("TMPDIR");
  } else {
    ::setenv("TMPDIR", kept.c_str(), 1);
  }
}

}  // namespace
}  // namespace tactus::host
