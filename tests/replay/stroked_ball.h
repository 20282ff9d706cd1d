// A baked ball that a simulated hand strokes, for tests that change its contact method or friction
// model.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/control/parameter_choices.h"
#include "host_tools/bake/scene/bake.h"
#include "rendering/scene/scene_image.h"
#include "rendering/scene/scene_world.h"
#include "tests/replay/scene_walk.h"

namespace tactus::testing {

inline constexpr firmware::ParameterPlace kContact{.parameter = firmware::Parameter::contact,
                                                   .object = 0};
inline constexpr firmware::ParameterPlace kModel{.parameter = firmware::Parameter::friction_model,
                                                 .object = 0};

// The methods that can render a mesh, a primitive and a formula.
inline const std::vector<std::string> kOnMeshes{"sphere_proxy", "god_object", "potential_field",
                                                "feature_walk", "one_plane",  "three_sub_goals",
                                                "three_step",   "one_step"};
inline const std::vector<std::string> kOnPrimitives{"sphere_proxy", "god_object",
                                                    "potential_field"};
inline const std::vector<std::string> kOnFormulas{"tracking", "plain_tracking"};

inline const std::string kRubs = "friction = { static = 0.6, dynamic = 0.4 }\n";
inline const std::string kFormula =
    "[[object]]\nname = \"ball\"\nformula = \"sphere(1)\"\nscale = 0.02\nstiffness_N_per_m = 500\n";
// The ball for a method that needs triangles: coarse ones, which are cut in little time.
inline const std::string kMesh = kFormula + "tolerance_m = 1e-4\n";
inline const std::string kPrimitive =
    "[[object]]\nname = \"ball\"\nprimitive = \"sphere\"\nradius_m = 0.02\nstiffness_N_per_m = "
    "500\n";
inline std::string contact(const std::string& name) {
  return "contact = \"" + name + "\"\n";
}

inline std::string model(std::string_view name) {
  const bool has_static = name != "coulomb" && name != "dahl";
  return fmt::format("friction = {{ model = \"{}\", dynamic = 0.4{} }}\n", name,
                     has_static ? ", static = 0.4" : "");
}

// Returns the image of a scene with these objects. A test that asks again gets the image made
// before: cutting a formula into triangles takes long.
inline const std::vector<std::byte>& baked(const std::string& objects) {
  static std::map<std::string, std::vector<std::byte>> images;
  const auto [image, is_new] = images.try_emplace(objects);
  if (is_new) {
    image->second =
        host::bake_scene(
            host::parse_scene_description("[tool]\nradius_m = 0.002\n" + objects, "scene.toml"), {})
            .bytes;
  }
  return image->second;
}

// A controller with a scene, active.
struct StrokedBall {
  explicit StrokedBall(std::vector<std::byte> bytes)
      : image(std::move(bytes)), scene(*rendering::SceneImage::open(image)) {
    EXPECT_TRUE(controller->configure(walking_config()));
    EXPECT_TRUE(controller->load_scene(scene.objects(), rendering::world_of(scene)));
  }

  void tick(const Vec3& p_W, firmware::Request request = firmware::Request::none) const {
    drivers::JointSample sample;
    sample.position = {p_W.x(), p_W.y(), p_W.z()};
    controller->tick(sample, request);
  }

  void start(const Vec3& p_W) const {
    for (const firmware::Request request :
         {firmware::Request::home, firmware::Request::none, firmware::Request::enable}) {
      tick(p_W, request);
    }
  }

  bool set(const firmware::ParameterPlace& place, std::string_view name) const {
    return controller->set_parameter({.place = place, .value = choice_of(place.parameter, name)})
        .has_value();
  }
  [[nodiscard]] firmware::ParameterRefusal refusal(const firmware::ParameterPlace& place,
                                                   double value) const {
    const auto done = controller->set_parameter({.place = place, .value = value});
    EXPECT_FALSE(done);
    return done ? firmware::ParameterRefusal{} : done.error();
  }
  [[nodiscard]] std::string_view now(const firmware::ParameterPlace& place) const {
    return choice_name(place.parameter, controller->parameter(place)->value);
  }

  [[nodiscard]] const firmware::TelemetryRecord& record() const { return controller->record(); }
  [[nodiscard]] bool touches() const { return record().contact != rendering::ContactKind::none; }

  const std::vector<std::byte> image;
  rendering::SceneImage scene;
  std::unique_ptr<firmware::Controller> controller = std::make_unique<firmware::Controller>();
};

// The tool's place at a tick: it comes down on a ball at the origin, slides and leaves it, and does
// so again. It is free up to kFree.
inline constexpr int kFree = 40;
inline constexpr int kStroke = 400;
inline Vec3 stroke(int tick) {
  const double s = 2.0 * 3.14159265358979 * tick / kStroke;
  return {0.006 * std::sin(3.0 * s), 0.024 + 0.008 * std::cos(s), 0.003 * std::sin(2.0 * s)};
}

}  // namespace tactus::testing
