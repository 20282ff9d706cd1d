// The state hash after a fixed walk over each example scene, and of a fixed motion of each preset,
// against the committed ones: a change of behaviour shows here, in its scene or preset. After a
// change that is wanted, TACTUS_RENEW_GOLDEN=1 writes tests/reference/golden_hashes.csv anew.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <string>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/geometry/portable_math.h"
#include "rendering/scene/scene_world.h"
#include "tests/replay/restore_check.h"
#include "tests/support/example_scenes.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/without_sign_check.h"

namespace tactus::testing {
namespace {

using firmware::Mode;
using firmware::Request;
using Hashes = std::map<std::string, std::string>;

const std::string kGoldenFile = in_repository("tests/reference/golden_hashes.csv");
constexpr int kTicks = 4000;

std::string text_of(std::uint64_t hash) {
  std::array<char, 20> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

// "name,hash" a line below the heading.
Hashes committed() {
  Hashes hashes;
  std::ifstream file(kGoldenFile);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::size_t comma = line.find(',');
    hashes[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return hashes;
}

void expect_golden(const std::string& kind, const Hashes& hashes) {
  Hashes all = committed();
  if (std::getenv("TACTUS_RENEW_GOLDEN") != nullptr) {
    std::erase_if(all, [&kind](const auto& entry) { return entry.first.starts_with(kind); });
    all.insert(hashes.begin(), hashes.end());
    std::ofstream file(kGoldenFile);
    file << "name,state_hash\n";
    for (const auto& [name, hash] : all) {
      file << name << ',' << hash << '\n';
    }
  }
  for (const auto& [name, hash] : hashes) {
    EXPECT_EQ(hash, all[name]) << name << "; if the change is wanted: TACTUS_RENEW_GOLDEN=1";
  }
}

using GoldenHashes = FolderTest;

TEST_F(GoldenHashes, OfAWalkOverEachExampleScene) {
  Hashes hashes;
  for (const std::string name : kExampleScenes) {
    const std::string image = file(name + ".tactus");
    host::bake_file(in_repository("host_tools/examples/" + name + "/scene.toml"), image);
    const host::MappedScene scene(image);
    const auto controller =
        loaded({.objects = scene.image().objects(), .world = rendering::world_of(scene.image())});
    SceneWalk walk(scene.image().objects(), 1);
    for (int tick = 0; tick < kTicks; ++tick) {
      give(*controller, walk.next(controller->mode()));
    }
    hashes["scene " + name] = text_of(controller->record().state_hash);
  }
  expect_golden("scene ", hashes);
}

// The middle of a joint's range; of one that may differ from another by so much only, the middle of
// that.
double middle_of(const firmware::ControllerConfig& config, std::size_t joint) {
  for (const firmware::CoupledLimit& coupled : config.coupled_limits) {
    if (coupled.upper > coupled.lower && coupled.minus == joint) {
      return middle_of(config, coupled.joint) - 0.5 * (coupled.upper + coupled.lower);
    }
  }
  return 0.5 * (config.joints[joint].upper + config.joints[joint].lower);
}

// Every joint swings about its middle by a twentieth of its range, each at its own pace.
drivers::JointSample swinging(const firmware::ControllerConfig& config, int tick) {
  constexpr double kPace_rad_per_s = 5.0;
  drivers::JointSample sample;
  for (std::size_t joint = 0; joint < firmware::joint_count(config.mechanism); ++joint) {
    const double swing = 0.05 * (config.joints[joint].upper - config.joints[joint].lower);
    const double pace = kPace_rad_per_s * (1.0 + 0.3 * static_cast<double>(joint));
    const rendering::SineCosine phase = rendering::sine_cosine(pace * 1e-3 * tick);
    sample.position[joint] = middle_of(config, joint) + swing * phase.sine;
    sample.velocity[joint] = swing * pace * phase.cosine;
  }
  return sample;
}

// A ball of 30 mm with friction, 1 mm before a tool of 2 mm at p_W that moves along v_W.
rendering::Object ball_before(const Vec3& p_W, const Vec3& v_W) {
  rendering::Object ball;
  ball.surface = rendering::SurfaceKind::primitive;
  ball.primitive.kind = rendering::PrimitiveKind::sphere;
  ball.primitive.dimensions_m = {0.03, 0.0, 0.0};
  ball.primitive.X_WO.translation = p_W + 0.033 * v_W.normalized();
  ball.material.stiffness_N_per_m = 200.0;
  ball.material.friction = {
      .kind = rendering::FrictionKind::cone, .coulomb = 0.4, .static_level = 0.5};
  return ball;
}

TEST_F(GoldenHashes, OfEachPresetThatSwingsOnABall) {
  Hashes hashes;
  for (const std::string_view name : firmware::kPresetNames) {
    const auto config = without_sign_check(*firmware::preset_config(name));
    const auto controller = std::make_unique<firmware::Controller>();
    ASSERT_TRUE(controller->configure(config));
    ASSERT_TRUE(controller->load_scene({}, {.tool_radius_m = 0.002}));
    for (int tick = 0; tick < 3; ++tick) {
      controller->tick(swinging(config, tick), tick == 0 ? Request::home : Request::none);
    }
    const auto p_W = controller->record().tool_p_W;
    const auto v_W = controller->record().tool_v_W;
    const rendering::Object ball = ball_before({p_W[0], p_W[1], p_W[2]}, {v_W[0], v_W[1], v_W[2]});
    ASSERT_TRUE(controller->load_scene({&ball, 1}, {.tool_radius_m = 0.002}));
    int contacts = 0;
    for (int tick = 0; tick < kTicks; ++tick) {
      controller->tick(swinging(config, tick), tick == 5 ? Request::enable : Request::none);
      contacts += controller->record().contact != rendering::ContactKind::none ? 1 : 0;
    }
    EXPECT_EQ(controller->mode(), Mode::active)
        << name << ", faults " << controller->record().faults;
    EXPECT_GT(contacts, 100) << name;
    hashes["preset " + std::string(name)] = text_of(controller->record().state_hash);
  }
  expect_golden("preset ", hashes);
}

}  // namespace
}  // namespace tactus::testing
