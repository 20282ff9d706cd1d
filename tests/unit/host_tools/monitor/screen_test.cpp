// The screens in screens/ are what a person has looked at and found right. To make them anew after
// a change of the layout: TACTUS_WRITE_SCREENS=1 build/release/tests/host_tools_tests, and look.
#include "host_tools/monitor/screen.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "firmware/safety/faults.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/monitor/example_run.h"

namespace tactus::host {
namespace {

std::string file_of(const std::string& name) {
  return testing::in_repository("tests/unit/host_tools/monitor/screens/" + name + ".txt");
}

std::string golden(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(file_of(name)).rdbuf();
  return std::move(text).str();
}

void expect_screen(const RunView& view, const std::string& name) {
  const std::string text = draw_screen(view).text();
  if (std::getenv("TACTUS_WRITE_SCREENS") != nullptr) {
    std::ofstream(file_of(name)) << text;
  }
  EXPECT_EQ(text, golden(name));
}

TEST(MonitorScreen, ShowsARunInContact) {
  expect_screen(example_run(), "active");
}

TEST(MonitorScreen, ShowsFaultsInWordsWithTheirRemedies) {
  RunView view = example_run();
  firmware::RecordedTick tick = example_tick(101, 3);
  tick.record.mode = firmware::Mode::fault;
  tick.record.faults =
      firmware::kFaultJointLimit | firmware::kFaultDrive | firmware::kFaultEmergencyStop;
  tick.record.force_commanded_W = {};
  tick.record.contact = rendering::ContactKind::none;
  view.take(tick);
  view.say("refused enable tick=101 mode=fault: the mode is fault (joint_limit); send reset first");
  expect_screen(view, "fault");
}

TEST(MonitorScreen, ShowsWhatHoldsTheForceBackBesideAFault) {
  RunView view = example_run();
  firmware::RecordedTick tick = example_tick(101, 3);
  tick.record.faults = firmware::kFaultDeviceLost | firmware::kFaultStaleSamples;
  tick.record.limits = firmware::kLimitForce | firmware::kLimitPassivity;
  tick.record.passivity_J = -0.01;
  tick.dropped = 12;
  view.take(tick);
  expect_screen(view, "limits");
}

TEST(MonitorScreen, ShowsASimulationAndSixAxes) {
  RunView view;
  view.take(RunInfo{{"scene", "bunny"}});
  firmware::RecordedTick tick = example_tick(3'723'456, 0);
  tick.loop = {.scheduled_ns = 3'723'456'000'000, .woke_ns = 0, .done_ns = 0, .sample_ns = 0};
  tick.joint_count = 6;
  view.take(tick);
  view.say("ok enable tick=3723456 mode=active");
  expect_screen(view, "simulation");
}

TEST(MonitorScreen, ExplainsATickInThePlaceOfTheAxesUntilThatIsOver) {
  RunView view = example_run();
  view.explain(example_explanation());
  expect_screen(view, "explained");
  view.explain(std::nullopt);
  expect_screen(view, "active");
}

TEST(MonitorScreen, ExplainsATickOfAFormulaThatHasNoNumbers) {
  RunView view = example_run();
  firmware::Explanation explanation = example_explanation();
  explanation.feature = {.object = 2, .kind = rendering::ContactKind::face};
  explanation.is_feature_known = false;
  explanation.moves = 0;
  explanation.iterations = 4;
  explanation.plane_count = 0;
  explanation.has_circle = false;
  explanation.surface_W[0] = std::numeric_limits<double>::infinity();
  view.explain(explanation);
  expect_screen(view, "explained_formula");
}

TEST(MonitorScreen, SaysThatTheControllerIsGone) {
  RunView view = example_run();
  view.lose();
  expect_screen(view, "gone");
}

TEST(MonitorScreen, WaitsForTheFirstTick) {
  expect_screen(RunView(), "waiting");
}

// Nothing of a number that a broken controller may send is printed as it is.
TEST(MonitorScreen, StaysWithinItsEdgesWhateverTheTickSays) {
  RunView view;
  view.take(RunInfo{{"device", std::string(200, 'x') + "\x1b[2J\n"}});
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), -1e300,
                             -std::numeric_limits<double>::infinity(), 999999.5}) {
    firmware::RecordedTick tick = example_tick(~0ULL, 3);
    tick.joint_count = ~0U;
    tick.record.mode = static_cast<firmware::Mode>(77);
    tick.record.contact = static_cast<rendering::ContactKind>(77);
    tick.record.friction = static_cast<rendering::FrictionState>(77);
    tick.record.faults = ~std::uint64_t{0};
    tick.record.limits = ~std::uint64_t{0};
    tick.record.joint_position.fill(value);
    tick.record.tool_p_W.fill(value);
    tick.record.force_commanded_W.fill(value);
    tick.record.energy_J.fill(value);
    tick.record.depth_m = value;
    tick.record.time_s = value;
    tick.dropped = ~0ULL;
    view.take(tick);
    view.say(std::string(500, 'y'));
    const std::string text = draw_screen(view).text();
    EXPECT_EQ(std::ranges::count(text, '\n'), static_cast<long>(kScreenRows));
    EXPECT_TRUE(text.contains("h home   e enable"));
    for (const char letter : text) {
      EXPECT_TRUE(letter == '\n' || (letter >= ' ' && letter <= '~'));
    }
  }
}

TEST(MonitorScreen, EveryFaultHasWordsAndARemedy) {
  for (const firmware::FaultText& text : firmware::kFaultTexts) {
    const FaultWords words = fault_words(text.bit, text.bit);
    const bool fault = (text.bit & firmware::kFaultMask) != 0;
    EXPECT_EQ(words.faults.size(), fault ? 1U : 0U) << text.name;
    EXPECT_EQ(words.limits.empty(), fault) << text.name;
    for (const std::string& remedy : words.remedies) {
      EXPECT_NE(remedy, "") << text.name;
    }
  }
}

}  // namespace
}  // namespace tactus::host
