#include "host_tools/files/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "host_tools/files/atomic_file.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;
using testing::TemporaryFolder;

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::ptrdiff_t files_in(const TemporaryFolder& folder) {
  return std::distance(std::filesystem::directory_iterator(folder.path()),
                       std::filesystem::directory_iterator());
}

TEST(OutputFileTest, IsThereOnlyOnceItIsWhole) {
  const TemporaryFolder folder;
  const auto path = folder.write("run.csv", "old");
  {
    OutputFile file(path, OutputKind::file);
    file.write(bytes_of("new"));
    EXPECT_EQ(read_file(path), "old");
    file.commit();
  }
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(files_in(folder), 1);
}

TEST(OutputFileTest, ThatIsGivenUpLeavesTheOldFileAndNothingBeside) {
  const TemporaryFolder folder;
  const auto path = folder.write("run.csv", "old");
  {
    OutputFile(path, OutputKind::file).write(bytes_of("half"));
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(files_in(folder), 1);
}

TEST(OutputFileTest, KeepsTheOldFilesPermissions) {
  const TemporaryFolder folder;
  const auto path = folder.write("run.csv", "old");
  std::filesystem::permissions(path, std::filesystem::perms{0640});
  write_file_atomically(path, bytes_of("new"));
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms{0640});
}

TEST(OutputFileTest, FollowsALinkToAFileAndKeepsTheLink) {
  const TemporaryFolder folder;
  const auto path = folder.write("kept.csv", "old");
  const auto link = folder.path() / "link.csv";
  std::filesystem::create_symlink(path, link);
  write_file_atomically(link, bytes_of("new"));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read_file(path), "new");
}

TEST(OutputFileTest, RefusesFoldersDevicesAndLinksToThem) {
  const TemporaryFolder folder;
  const auto to_device = folder.path() / "zero.csv";
  const auto to_nothing = folder.path() / "nothing.csv";
  std::filesystem::create_symlink("/dev/zero", to_device);
  std::filesystem::create_symlink(folder.path() / "is_not_there", to_nothing);
  const auto why = [](const std::filesystem::path& path) {
    return input_error([&] { write_file_atomically(path, bytes_of("x")); });
  };
  EXPECT_TRUE(contains(why(folder.path()), "is a folder"));
  EXPECT_TRUE(contains(why("/dev/zero"), "is a device"));
  EXPECT_TRUE(contains(why(to_device), "is a device"));
  EXPECT_TRUE(contains(why(to_nothing), "is a link to nothing"));
  EXPECT_TRUE(contains(why("-"), "/dev/stdout"));
  EXPECT_TRUE(std::filesystem::is_symlink(to_device));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/zero"));
}

TEST(OutputFileTest, WritesIntoAPipeAsItIs) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // Linux opens a pipe for both ways at once, so that the writer finds a reader.
  std::FILE* reader = std::fopen(pipe.c_str(), "r+");
  ASSERT_NE(reader, nullptr);
  write_file_atomically(pipe, bytes_of("rows\n"));
  std::array<char, 16> read{};
  EXPECT_NE(std::fgets(read.data(), read.size(), reader), nullptr);
  std::fclose(reader);
  EXPECT_STREQ(read.data(), "rows\n");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_TRUE(contains(input_error([&] { OutputFile(pipe, OutputKind::file).commit(); }),
                       "must be a file"));
}

TEST(OutputFileTest, TellsOfAFullDevice) {
  const auto why =
      input_error([] { write_file_atomically("/dev/full", bytes_of("more than nothing")); });
  EXPECT_TRUE(contains(why, "/dev/full: cannot write: No space left on device"));
}

TEST(KeepInputsSafe, KnowsAnInputUnderEveryName) {
  const TemporaryFolder folder;
  const auto input = folder.write("path.csv", "rows");
  const auto hard = folder.path() / "hard.csv";
  const auto soft = folder.path() / "soft.csv";
  std::filesystem::create_hard_link(input, hard);
  std::filesystem::create_symlink(input, soft);
  for (const auto& name : {input, hard, soft, folder.path() / "." / "path.csv"}) {
    const auto why = input_error([&] { keep_inputs_safe({name}, {input}); });
    EXPECT_TRUE(contains(why, "is the input ")) << name;
  }
  keep_inputs_safe({folder.path() / "new.csv", "", "/dev/stdout"}, {input, ""});
}

TEST(KeepInputsSafe, RefusesOneFileForTwoOutputs) {
  const TemporaryFolder folder;
  const auto a = folder.path() / "a.csv";
  EXPECT_TRUE(contains(input_error([&] { keep_inputs_safe({a, folder.path() / "./a.csv"}, {}); }),
                       "is named for two outputs"));
}

}  // namespace
}  // namespace tactus::host
