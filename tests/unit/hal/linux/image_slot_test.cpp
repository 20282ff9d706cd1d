#include "hal/linux/image_slot.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace tactus::hal {
namespace {

constexpr std::size_t kSlot_bytes = std::size_t{1} << 20;

class ImageSlotTest : public ::testing::Test {
 public:
  ImageSlotTest(const ImageSlotTest&) = delete;
  ImageSlotTest& operator=(const ImageSlotTest&) = delete;
  ~ImageSlotTest() override { std::filesystem::remove_all(folder_); }

 protected:
  ImageSlotTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tactus-slot-XXXXXX").string();
    EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    EXPECT_EQ(slot_.reserve(kSlot_bytes), 0);
  }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  [[nodiscard]] std::string read() const {
    std::string text;
    std::ranges::transform(slot_.bytes(), std::back_inserter(text),
                           [](std::byte byte) { return static_cast<char>(byte); });
    return text;
  }

  std::filesystem::path folder_;
  ImageSlot slot_;
};

TEST_F(ImageSlotTest, KeepsWhatItReadWhateverHappensToTheFile) {
  const std::string path = write("image", "first bytes");
  ASSERT_FALSE(slot_.read(path.c_str()).is_error());
  write("image", "other");
  EXPECT_EQ(read(), "first bytes");
  ASSERT_EQ(::truncate(path.c_str(), 0), 0);
  EXPECT_EQ(read(), "first bytes");
  ASSERT_EQ(::unlink(path.c_str()), 0);
  EXPECT_EQ(read(), "first bytes");
}

// The kernel itself may not write there.
TEST_F(ImageSlotTest, IsReadOnlyOnceItWasRead) {
  ASSERT_FALSE(slot_.read(write("image", "first bytes").c_str()).is_error());
  const FileDescriptor zeros(::open("/dev/zero", O_RDONLY | O_CLOEXEC));
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): the write is refused
  EXPECT_EQ(::read(zeros.get(), const_cast<std::byte*>(slot_.bytes().data()), 1), -1);
  EXPECT_EQ(errno, EFAULT);
  EXPECT_EQ(read(), "first bytes");
}

TEST_F(ImageSlotTest, HoldsOneFileAfterTheOther) {
  ASSERT_FALSE(slot_.read(write("long", std::string(kSlot_bytes, 'x')).c_str()).is_error());
  EXPECT_EQ(slot_.bytes().size(), kSlot_bytes);
  ASSERT_FALSE(slot_.read(write("short", "y").c_str()).is_error());
  EXPECT_EQ(read(), "y");
  slot_.clear();
  EXPECT_TRUE(slot_.bytes().empty());
}

TEST_F(ImageSlotTest, RefusesAPipeAtOnce) {
  const std::string path = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const TimeNs before_ns = monotonic_now_ns();
  EXPECT_TRUE(slot_.read(path.c_str()).is_error());
  EXPECT_LT(monotonic_now_ns() - before_ns, kNsPerSecond);
}

TEST_F(ImageSlotTest, RefusesAFolderADeviceAndAnEmptyFile) {
  EXPECT_TRUE(slot_.read(folder_.c_str()).is_error());
  EXPECT_TRUE(slot_.read("/dev/null").is_error());
  EXPECT_TRUE(slot_.read("/dev/zero").is_error());
  EXPECT_TRUE(slot_.read(write("empty", "").c_str()).is_error());
  EXPECT_EQ(slot_.read("/no/such/file").errno_value, ENOENT);
}

TEST_F(ImageSlotTest, RefusesWhatIsLargerThanItselfBeforeItReads) {
  const std::string path = write("sparse", "x");
  ASSERT_EQ(::truncate(path.c_str(), off_t{2} << 30), 0);
  const FileError error = slot_.read(path.c_str());
  EXPECT_NE(error.what.find("--scene-memory"), std::string_view::npos) << error.what;
  EXPECT_TRUE(slot_.bytes().empty());
}

TEST_F(ImageSlotTest, FollowsALinkToAFile) {
  const std::string target = write("target", "through the link");
  const std::string link = (folder_ / "link").string();
  ASSERT_EQ(::symlink(target.c_str(), link.c_str()), 0);
  ASSERT_FALSE(slot_.read(link.c_str()).is_error());
  EXPECT_EQ(read(), "through the link");
}

}  // namespace
}  // namespace tactus::hal
