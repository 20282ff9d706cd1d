#include "firmware/linux/telemetry/file_sink.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace tactus::firmware {
namespace {

class FileSinkTest : public ::testing::Test {
 public:
  FileSinkTest(const FileSinkTest&) = delete;
  FileSinkTest& operator=(const FileSinkTest&) = delete;
  ~FileSinkTest() override { std::filesystem::remove_all(folder_); }

 protected:
  FileSinkTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tactus-sink-XXXXXX").string();
    EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    there_ = (folder_ / "there").string();
    std::ofstream(there_) << "precious";
  }

  [[nodiscard]] std::string content() const {
    std::string line;
    std::ifstream file(there_);
    std::getline(file, line);
    return line;
  }

  std::filesystem::path folder_;
  std::string there_;
  FileSink sink_;
};

TEST_F(FileSinkTest, MadeExclusivelyTouchesNoFileThatIsThere) {
  EXPECT_EQ(sink_.open(there_.c_str(), IfThere::refuse), EEXIST);
  EXPECT_EQ(content(), "precious");
}

TEST_F(FileSinkTest, NeverFollowsALinkAndDoesNotMakeItsTarget) {
  const std::string link = (folder_ / "link").string();
  ASSERT_EQ(::symlink(there_.c_str(), link.c_str()), 0);
  EXPECT_EQ(sink_.open(link.c_str(), IfThere::refuse), EEXIST);
  EXPECT_EQ(sink_.open(link.c_str(), IfThere::replace), ELOOP);
  EXPECT_EQ(content(), "precious");
  const std::string dangling = (folder_ / "dangling").string();
  ASSERT_EQ(::symlink((folder_ / "target").c_str(), dangling.c_str()), 0);
  EXPECT_NE(sink_.open(dangling.c_str(), IfThere::refuse), 0);
  EXPECT_NE(sink_.open(dangling.c_str(), IfThere::replace), 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "target"));
}

TEST_F(FileSinkTest, EmptiesARegularFileOnlyWhereThatIsAsked) {
  EXPECT_EQ(sink_.open(there_.c_str(), IfThere::replace), 0);
  EXPECT_EQ(content(), "");
}

TEST_F(FileSinkTest, RefusesAPipeWithoutWaitingAndADeviceWhereAFileIsToBeMade) {
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(sink_.open(pipe.c_str(), IfThere::replace), EEXIST);
  EXPECT_EQ(sink_.open("/dev/null", IfThere::refuse), EEXIST);
}

}  // namespace
}  // namespace tactus::firmware
