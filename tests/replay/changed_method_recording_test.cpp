// A recording in which a contact method or a friction model was changed replays to its end, and
// `replay --set` computes what another one would have given.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "host_tools/input_error.h"
#include "host_tools/replay/replay.h"
#include "host_tools/replay/what_if.h"
#include "tests/replay/recorded_walk.h"
#include "tests/replay/stroked_ball.h"

namespace tactus::testing {
namespace {

using firmware::Parameter;
using firmware::Request;

class ChangedMethodRecording : public RecordedWalk {
 protected:
  ChangedMethodRecording() : RecordedWalk(baked(kMesh + contact("sphere_proxy") + kRubs)) {}

  // The device at the tick's place of the stroke, with the request by which it starts.
  static TickInput input(int tick) {
    constexpr std::array kStart{Request::home, Request::none, Request::enable};
    TickInput input;
    const Vec3 p_W = stroke(tick);
    input.sample.position = {p_W.x(), p_W.y(), p_W.z()};
    input.request = static_cast<std::size_t>(tick) < kStart.size()
                        ? kStart.at(static_cast<std::size_t>(tick))
                        : Request::none;
    return input;
  }
};

TEST_F(ChangedMethodRecording, IsReplayed) {
  for (int i = 0; i < 4 * kStroke; ++i) {
    TickInput now = input(i);
    if (i % kStroke == kFree) {
      now.change = {
          .place = kContact,
          .value = choice_of(Parameter::contact, i < kStroke ? "god_object" : "feature_walk")};
    } else if (i % kStroke == kFree + 1) {
      now.change = {.place = kModel, .value = choice_of(Parameter::friction_model, "dahl")};
    } else if (i % kStroke == kStroke / 2) {
      now.change = {.place = kContact, .value = choice_of(Parameter::contact, "sphere_proxy")};
    }
    tick(now);
  }
  EXPECT_GT(contacts_, 400U);
  ASSERT_EQ(recorder_->close(), 0);
  host::RecordedRun run(path_, {});
  const host::ReplayResult result = host::replay(run);
  ASSERT_FALSE(result.difference) << result.difference->tick << ' ' << result.difference->field;
  EXPECT_EQ(result.ticks, 4U * kStroke);
}

TEST_F(ChangedMethodRecording, AnotherMethodFromTheStartIsThatOfAnotherScene) {
  for (int i = 0; i < 2 * kStroke; ++i) {
    tick(input(i));
  }
  ASSERT_EQ(recorder_->close(), 0);
  struct WhatIf {
    const char* set;
    std::string scene;
  };
  const std::vector<WhatIf> all{
      {.set = "object.ball.contact=one_plane", .scene = kMesh + contact("one_plane") + kRubs},
      {.set = "object.0.friction_model=dahl",
       .scene = kMesh + contact("sphere_proxy") + model("dahl")}};
  for (const auto& [set, scene] : all) {
    SCOPED_TRACE(set);
    StrokedBall wanted(baked(scene));
    std::vector<Vec3> forces_W;
    for (int i = 0; i < 2 * kStroke; ++i) {
      give(*wanted.controller, input(i));
      const auto& force = wanted.record().force_commanded_W;
      forces_W.emplace_back(force[0], force[1], force[2]);
    }
    host::RecordedRun run(path_, {});
    const std::array changes{host::parse_change(set, run.scene())};
    std::size_t next = 0;
    double most_apart_N = 0.0;
    host::what_if(run, changes, [&](const host::WhatIfTick& tick) {
      EXPECT_EQ(tick.changed_W, forces_W.at(next++));
      most_apart_N = std::max(most_apart_N, (tick.changed_W - tick.recorded_W).norm());
    });
    EXPECT_EQ(next, forces_W.size());
    EXPECT_GT(most_apart_N, 1e-3);
  }
}

TEST_F(ChangedMethodRecording, AWrongNameIsRefusedWithTheAllowedOnes) {
  tick(input(0));
  ASSERT_EQ(recorder_->close(), 0);
  const auto error = [&](const char* text) -> std::string {
    try {
      host::RecordedRun run(path_, {});
      const std::array changes{host::parse_change(text, run.scene())};
      host::what_if(run, changes, [](const auto&) {});
    } catch (const host::InputError& refused) {
      return refused.what();
    }
    return {};
  };
  EXPECT_TRUE(error("object.ball.contact=two_planes")
                  .ends_with("; write one of sphere_proxy, god_object, potential_field, "
                             "feature_walk, one_plane, three_sub_goals, three_step, one_step"))
      << error("object.ball.contact=two_planes");
  EXPECT_TRUE(error("object.ball.contact=tracking").find("write one of sphere_proxy") !=
              std::string::npos);
  EXPECT_TRUE(error("object.ball.friction_model=5").find("write one of cone, coulomb") !=
              std::string::npos);
}

}  // namespace
}  // namespace tactus::testing
