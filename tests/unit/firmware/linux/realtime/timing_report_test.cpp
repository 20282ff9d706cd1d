#include "firmware/linux/realtime/timing_report.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace tactus::firmware {
namespace {

LoopTiming two_ticks() {
  LoopTiming timing;
  for (const hal::TimeNs tick_ns : {40'000, 1'400'000}) {
    LoopTick tick = timing.woke({.scheduled_ns = 1000, .woke_ns = 8000, .skipped = 0});
    timing.done(tick, {.read = 20'000, .touch = 3'000}, tick.woke_ns + tick_ns);
  }
  return timing;
}

TEST(TimingReport, HistogramHasTheBinsThatHoldSomethingAndTheRest) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("tactus_histogram_" + std::to_string(getpid()) + ".csv");
  ASSERT_EQ(write_histogram(path.c_str(), two_ticks()), 0);
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::filesystem::remove(path);
  EXPECT_EQ(text.str(),
            "time_us,wake_up,tick,read,check,kinematics,touch,safety,write\n"
            "0,0,0,0,2,2,0,2,2\n"
            "3,0,0,0,0,0,2,0,0\n"
            "7,2,0,0,0,0,0,0,0\n"
            "20,0,0,2,0,0,0,0,0\n"
            "40,0,1,0,0,0,0,0,0\n"
            "1000,0,1,0,0,0,0,0,0\n");
}

TEST(TimingReport, SaysWhyAHistogramCannotBeWritten) {
  EXPECT_EQ(write_histogram("/nowhere/at/all.csv", LoopTiming{}), ENOENT);
}

TEST(TimingReport, SummaryNamesTicksMissedOnesAndEveryStage) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  print_timing(file, two_ticks());
  ASSERT_EQ(std::fseek(file, 0, SEEK_SET), 0);
  std::string text(4096, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  EXPECT_TRUE(text.starts_with("2 ticks, 0 missed, 0 late\n")) << text;
  for (const std::string_view name : kTimedNames) {
    EXPECT_NE(text.find("\n" + std::string(name) + " "), std::string::npos) << text;
  }
  EXPECT_NE(text.find("1400.0"), std::string::npos) << text;
}

}  // namespace
}  // namespace tactus::firmware
