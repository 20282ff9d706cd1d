// An object whose contact method or friction model is changed while it runs feels as if its scene
// had been baked so.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/friction/registered_models.h"
#include "tests/replay/stroked_ball.h"

namespace tactus::testing {
namespace {

using firmware::Parameter;
using firmware::ParameterPlace;
using firmware::ParameterRefusal;

// A ball of a mesh, with its middle at x.
std::string meshed_ball(const std::string& contact, double x_m) {
  return fmt::format(
      "[[object]]\nname = \"at {0}\"\nformula = \"sphere(1)\"\nscale = 0.02\nposition_m = [{0}, 0, "
      "0]\ntolerance_m = 1e-4\nstiffness_N_per_m = 500\ncontact = \"{1}\"\n{2}",
      x_m, contact, kRubs);
}

void expect_equal_touches(const StrokedBall& a, const StrokedBall& b, int tick) {
  ASSERT_EQ(a.record().force_commanded_W, b.record().force_commanded_W) << "tick " << tick;
  ASSERT_EQ(a.record().proxy_W, b.record().proxy_W) << "tick " << tick;
  ASSERT_EQ(a.record().contact, b.record().contact) << "tick " << tick;
}

// Sets a parameter in a run of the scene `from` while the tool is free, and expects the touches of
// the scene `to` from then on.
void expect_as_baked(const std::string& from, const std::string& to, const ParameterPlace& place,
                     std::string_view name) {
  SCOPED_TRACE(fmt::format("from {} to {}", from, to));
  StrokedBall changed(baked(from));
  StrokedBall wanted(baked(to));
  changed.start(stroke(0));
  wanted.start(stroke(0));
  std::size_t contacts = 0;
  for (int tick = 0; tick < 2 * kStroke; ++tick) {
    if (tick == kFree) {
      ASSERT_TRUE(changed.set(place, name));
      EXPECT_EQ(changed.now(place), name);
    }
    changed.tick(stroke(tick));
    wanted.tick(stroke(tick));
    if (tick >= kFree) {
      ASSERT_NO_FATAL_FAILURE(expect_equal_touches(changed, wanted, tick));
    }
    contacts += wanted.touches() ? 1U : 0U;
  }
  EXPECT_GT(contacts, 100U);
}

void expect_every_pair(const std::string& object, const std::vector<std::string>& methods,
                       const std::string& rest) {
  for (const std::string& from : methods) {
    for (const std::string& to : methods) {
      if (from != to) {
        ASSERT_NO_FATAL_FAILURE(expect_as_baked(fmt::format("{}{}{}", object, contact(from), rest),
                                                fmt::format("{}{}{}", object, contact(to), rest),
                                                kContact, to));
      }
    }
  }
}

TEST(ChangedMethod, FeelsAsBakedForEveryPairOnAMesh) {
  expect_every_pair(kMesh, kOnMeshes, kRubs);
}

TEST(ChangedMethod, FeelsAsBakedForEveryPairOnAPrimitive) {
  expect_every_pair(kPrimitive, kOnPrimitives, kRubs);
}

TEST(ChangedMethod, FeelsAsBakedForEveryPairOnAFormula) {
  expect_every_pair(kFormula, kOnFormulas, "");
}

TEST(ChangedMethod, AFrictionModelFeelsAsBakedForEveryPair) {
  for (const rendering::FrictionModelTraits& from : rendering::kFrictionModels) {
    for (const rendering::FrictionModelTraits& to : rendering::kFrictionModels) {
      if (from.kind != to.kind) {
        ASSERT_NO_FATAL_FAILURE(expect_as_baked(kFormula + model(from.name),
                                                kFormula + model(to.name), kModel, to.name));
      }
    }
  }
}

TEST(ChangedMethod, AnObjectAllowsWhatAScenesKeysAllow) {
  const auto allowed = [](const std::string& text, const ParameterPlace& place) {
    const StrokedBall run(baked(text));
    std::vector<std::string> names;
    for_each_choice(place.parameter, *run.controller->parameter(place),
                    [&](std::string_view name) { names.emplace_back(name); });
    return names;
  };
  EXPECT_EQ(allowed(kMesh + contact("one_plane") + kRubs, kContact), kOnMeshes);
  EXPECT_EQ(allowed(kPrimitive, kContact), kOnPrimitives);
  EXPECT_EQ(allowed(kFormula, kContact), kOnFormulas);
  EXPECT_EQ(allowed(kFormula + kRubs, kContact), std::vector<std::string>{"tracking"});
  const std::vector<std::string> without_textbook(kOnMeshes.begin(), kOnMeshes.begin() + 4);
  EXPECT_EQ(allowed(kMesh + contact("god_object") + model("dahl"), kContact), without_textbook);
  const std::string grain = kRubs + "grain = { direction = [1, 0, 0], across = 0.5 }\n";
  const std::vector<std::string> with_grain{"sphere_proxy", "god_object", "feature_walk"};
  EXPECT_EQ(allowed(kMesh + contact("god_object") + grain, kContact), with_grain);
  EXPECT_EQ(allowed(kMesh + contact("god_object") + "shading = {}\n", kContact), with_grain);
  EXPECT_EQ(allowed(kMesh + contact("one_plane"), kModel), std::vector<std::string>{"cone"});
  EXPECT_EQ(allowed(kFormula + kRubs, kModel).size(), rendering::kFrictionKinds);
  // Bristles need the stiffness of the contact, and every model but the cone a dynamic level.
  const std::string soft =
      "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.02\n"
      "stiffness_N_per_m = 0\n" +
      kRubs;
  const std::vector<std::string> without_bristles{"cone", "coulomb", "stribeck", "karnopp"};
  EXPECT_EQ(allowed(soft, kModel), without_bristles);
}

TEST(ChangedMethod, IsRefusedInContactAndTakenOnceTheToolIsLifted) {
  for (const std::string& from : kOnMeshes) {
    const std::string to = from == "one_plane" ? "god_object" : "one_plane";
    SCOPED_TRACE(from);
    StrokedBall run(baked(fmt::format("{}{}{}", kMesh, contact(from), kRubs)));
    run.start(stroke(0));
    int refused = 0;
    for (int tick = 0; tick < 2 * kStroke; ++tick) {
      run.tick(stroke(tick));
      if (!run.touches()) {
        continue;
      }
      ++refused;
      const std::uint64_t hash = run.record().state_hash;
      EXPECT_EQ(run.refusal(kContact, choice_of(Parameter::contact, to)),
                ParameterRefusal::touched);
      if (!rendering::is_textbook(run.scene.objects()[0].method)) {
        EXPECT_EQ(run.refusal(kModel, choice_of(Parameter::friction_model, "dahl")),
                  ParameterRefusal::touched);
      }
      EXPECT_EQ(run.now(kContact), from);
      EXPECT_EQ(run.record().state_hash, hash);
    }
    EXPECT_GT(refused, 100);
    run.tick(stroke(0));
    run.tick(stroke(0));
    EXPECT_TRUE(run.set(kContact, to));
    EXPECT_EQ(run.now(kContact), to);
  }
}

// One tool rests on a ball, while the other ball gets every method in turn.
TEST(ChangedMethod, OfAnotherObjectIsNotFelt) {
  for (const std::string& held_by : kOnMeshes) {
    SCOPED_TRACE(held_by);
    const bool shares = held_by == "sphere_proxy" || held_by == "god_object";
    const auto scene = baked(meshed_ball("one_plane", 0.1) + meshed_ball(held_by, 0.0) +
                             meshed_ball("one_plane", 0.2));
    StrokedBall changed(scene);
    StrokedBall left(scene);
    changed.start(stroke(0));
    left.start(stroke(0));
    std::size_t next = 0;
    std::size_t done = 0;
    for (int tick = 0; tick < 2 * kStroke; ++tick) {
      if (left.touches() && tick % 5 == 0) {
        const ParameterPlace other{.parameter = Parameter::contact,
                                   .object = tick % 2 == 0 ? 0U : 2U};
        const std::string& name = kOnMeshes[next++ % kOnMeshes.size()];
        const bool is_of_proxy = name == "sphere_proxy" || name == "god_object";
        const bool is_set = changed.set(other, name);
        EXPECT_EQ(is_set, changed.now(other) == name);
        EXPECT_TRUE(is_set || (shares && is_of_proxy)) << name;
        done += is_set ? 1U : 0U;
      }
      changed.tick(stroke(tick));
      left.tick(stroke(tick));
      ASSERT_NO_FATAL_FAILURE(expect_equal_touches(changed, left, tick));
    }
    EXPECT_GT(done, 20U);
  }
}

TEST(ChangedMethod, OutlivesASaveAndARestore) {
  const auto scene = baked(kMesh + contact("sphere_proxy") + kRubs);
  StrokedBall first(scene);
  first.start(stroke(0));
  for (int tick = 0; tick < kFree; ++tick) {
    first.tick(stroke(tick));
  }
  ASSERT_TRUE(first.set(kModel, "lugre"));
  first.tick(stroke(kFree));
  ASSERT_TRUE(first.set(kContact, "feature_walk"));
  std::vector<std::byte> bytes(firmware::kMaxCheckpointBytes);
  const std::size_t size = first.controller->save(bytes);
  ASSERT_GT(size, 0U);
  StrokedBall second(scene);
  ASSERT_TRUE(second.set(kContact, "three_step"));
  ASSERT_TRUE(second.controller->restore(std::span(bytes).first(size)));
  EXPECT_EQ(second.now(kContact), "feature_walk");
  EXPECT_EQ(second.now(kModel), "lugre");
  for (int tick = kFree; tick < 2 * kStroke; ++tick) {
    first.tick(stroke(tick));
    second.tick(stroke(tick));
    ASSERT_EQ(first.record().state_hash, second.record().state_hash) << "tick " << tick;
  }
}

}  // namespace
}  // namespace tactus::testing
