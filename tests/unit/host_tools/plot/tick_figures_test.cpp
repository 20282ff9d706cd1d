// The figures of ticks, as a user draws them with the program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/tick_steps.h"
#include "tests/support/apng_reader.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/png_size.h"
#include "tests/support/run_program.h"
#include "tests/support/xml_check.h"

namespace tactus::host {
namespace {

class TickFiguresTest : public FolderTest {
 protected:
  void SetUp() override {
    touch("gem", "stroke", "gem");
    touch("heart", "gyroid", "gyroid");
  }

  // Draws, and returns what the program printed.
  std::string plot(const std::string& arguments, const std::string& scene, int exit_code = 0) {
    const testing::Outcome outcome = testing::run_program(
        folder(), "plot " + scene + ".csv --scene " + scene + ".tactus --explain " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.output;
    return outcome.output;
  }

  std::string drawn(const std::string& name) {
    std::string text = read_file(file(name));
    EXPECT_EQ(testing::xml_fault(text), "") << name;
    return text;
  }

 private:
  void touch(const std::string& example, const std::string& path, const std::string& name) {
    const std::string place = testing::in_repository("host_tools/examples/" + example);
    for (const std::string& command :
         {fmt::format("bake '{}/scene.toml' -o {}.tactus", place, name),
          fmt::format("touch {1}.tactus --path '{0}/{2}.csv' -o run.csv --explain {1}.csv", place,
                      name, path)}) {
      const testing::Outcome outcome = testing::run_program(folder(), command);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    }
  }
};

// Returns how often a text is in another one.
std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST_F(TickFiguresTest, ATickOnAFormulaHasItsFieldBehindIt) {
  plot("--tick 109 -o tick.svg", "gyroid");
  const std::string text = drawn("tick.svg");
  EXPECT_EQ(count_of(text, "data:image/png;base64,"), 2U);
  for (const std::string label :
       {"F = 0, the surface", "tangent plane", "seed: proxy before", "tolerance: in contact",
        "F (the unit of the formula)", "4 iterations: free, 2 stopped, settled"}) {
    EXPECT_GE(count_of(text, label), 1U) << label;
  }
}

TEST_F(TickFiguresTest, ATickOnAMeshHasTheSameLabelsInEveryFormat) {
  plot("--tick 870 -o tick.svg", "gem");
  const std::string text = drawn("tick.svg");
  for (const std::string label : {"gem.csv: tick 870 at 3.48 s", "friction cone, static",
                                  "proxy (god-object)", "tool (HIP)"}) {
    EXPECT_GE(count_of(text, label), 1U) << label;
  }
  plot("--tick 870 --format pdf -o new/", "gem");
  EXPECT_TRUE(read_file(file("new/gem_tick870.pdf")).starts_with("%PDF-"));
  plot("--tick 870 -o tick.png", "gem");
  EXPECT_EQ(testing::png_size(file("tick.png")).width, 1800U);
}

TEST_F(TickFiguresTest, ThePanelsOfAStripHaveCommonAxes) {
  plot("--ticks 858..878/10 -o strip.svg", "gem");
  const std::string text = drawn("strip.svg");
  for (const std::string label : {"tick 858, 3.432 s", "tick 868, 3.472 s", "tick 878, 3.512 s"}) {
    EXPECT_GE(count_of(text, label), 1U) << label;
  }
  // The marks of the three x axes stand at the same distances from each other, with the same
  // numbers: the panels are 440 pixels apart.
  const std::regex mark(
      R"(translate\(([0-9.]+),([0-9.]+)\)[^<]*>\s*<text>(?:<tspan[^>]*>)?\s*(-?[0-9.]+)<)");
  std::vector<std::pair<std::string, double>> marks;
  double lowest = 0.0;
  for (std::sregex_iterator it(text.begin(), text.end(), mark), end; it != end; ++it) {
    lowest = std::max(lowest, std::stod((*it)[2]));
  }
  for (std::sregex_iterator it(text.begin(), text.end(), mark), end; it != end; ++it) {
    if (std::abs(std::stod((*it)[2]) - lowest) < 1.0) {
      marks.emplace_back((*it)[3], std::stod((*it)[1]));
    }
  }
  ASSERT_GE(marks.size(), 6U);
  ASSERT_EQ(marks.size() % 3, 0U);
  const std::size_t each = marks.size() / 3;
  for (std::size_t i = 0; i + each < marks.size(); ++i) {
    EXPECT_EQ(marks[i].first, marks[i + each].first);
    EXPECT_NEAR(marks[i + each].second - marks[i].second, 440.0, 1.0);
  }
}

TEST_F(TickFiguresTest, AnAnimationHasAFrameForEachTickTenTimesSlower) {
  const std::string output = plot("--ticks 105..114/3 --animation s.apng", "gyroid");
  EXPECT_NE(output.find("s.apng: 4 frames, 8.333 a second"), std::string::npos) << output;
  std::size_t frames = 0;
  for (const testing::PngChunk& chunk : testing::png_chunks(read_file(file("s.apng")))) {
    EXPECT_TRUE(chunk.is_sound);
    if (chunk.type == "fcTL") {
      ++frames;
      // Three ticks of 4 ms, ten times slower.
      EXPECT_NEAR(static_cast<double>(testing::png_number(chunk.content, 20, 2)) /
                      static_cast<double>(testing::png_number(chunk.content, 22, 2)),
                  0.12, 1e-4);
    }
  }
  EXPECT_EQ(frames, 4U);
  plot("--ticks 105..106 --animation t.apng --frames-per-second 25", "gyroid");
  const auto chunks = testing::png_chunks(read_file(file("t.apng")));
  const auto control = std::ranges::find(chunks, "fcTL", &testing::PngChunk::type);
  EXPECT_EQ(25U * testing::png_number(control->content, 20, 2),
            testing::png_number(control->content, 22, 2));
}

TEST_F(TickFiguresTest, FramesAreNumberedInANewFolder) {
  plot("--ticks 866..870/2 --frames frames --format svg", "gem");
  EXPECT_NE(drawn("frames/frame_0001.svg").find("tick 866"), std::string::npos);
  EXPECT_NE(drawn("frames/frame_0003.svg").find("tick 870"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file("frames/frame_0004.svg")));
  EXPECT_NE(plot("--ticks 866..870/2 --frames frames", "gem", 2).find("the folder is not empty"),
            std::string::npos);
}

TEST_F(TickFiguresTest, AnotherFormatIsRefusedWithTheThreeThatThereAre) {
  EXPECT_NE(plot("--tick 870 --format gif", "gem", 2).find("gif not in {png,svg,pdf}"),
            std::string::npos);
}

TEST_F(TickFiguresTest, WhatCannotBeDrawnIsRefusedWithTheRemedy) {
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const std::string output = plot(arguments, "gem", 2);
    EXPECT_NE(output.find(message), std::string::npos) << output;
  };
  refused("--ticks 800..900/5",
          "21 ticks are too many for a strip, which has at most 8; take a "
          "larger step, such as 800..900/15");
  refused("--ticks 999990..999993", "no tick 999990; it has the ticks 0 to");
  refused("--tick 870 -o t.gif", "t.gif: a picture's name ends in .png, .svg or .pdf");
  refused("--ticks 866..870 --animation a.gif", "a.gif: an animation's name ends in .apng or .png");
  const testing::Outcome other = testing::run_program(
      folder(), "plot gyroid.csv --scene gem.tactus --explain --tick 109 -o t.png");
  EXPECT_NE(other.output.find("the scene has none there; give the scene of the run"),
            std::string::npos)
      << other.output;
}

TEST(TickRange, IsReadAsTheUserWritesIt) {
  const TickRange range = parse_tick_range("860..881/5");
  EXPECT_EQ(range.first, 860U);
  EXPECT_EQ(range.last, 881U);
  EXPECT_EQ(range.step, 5U);
  EXPECT_EQ(range.count(), 5U);
  EXPECT_EQ(parse_tick_range("7..7").count(), 1U);
  for (const std::string text : {"", "5", "5..", "..7", "8..7", "1..9/0", "1..9/", "1..9/2x",
                                 "1...9", "-1..9", "1..9 /2", "99999999999999999999999..1"}) {
    EXPECT_THROW(static_cast<void>(parse_tick_range(text)), InputError) << text;
  }
}

}  // namespace
}  // namespace tactus::host
