// The same wanderings over objects that fly, tumble and boil: seen from the object the proxy
// crosses nothing and keeps its radius, at the ends of a tick and all through it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "rendering/contact/tick_watcher.h"
#include "rendering/world/world.h"
#include "tests/property/wanderer.h"
#include "tests/support/brute_force.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::Object;
using rendering::ProxyPath;
using rendering::RigidPose;
using rendering::Sides;
using rendering::to_vec3;
using rendering::Touch;
using rendering::World;

constexpr double kMovingTolerance_m = 1e-6;
// Fewer ticks on a shape may pass beside it.
constexpr std::size_t kTicksToMeetEveryMover = 300;

struct MovingCase {
  Shape shape;
  Sides sides;
  double radius_m;
  double mu;
  std::uint64_t seed;
};

struct MovingTally {
  std::size_t contacts = 0;
  std::size_t pinched = 0;
  double worst_clearance_m = 1.0;
};

Object changing(const Solid& solid, bool deforms) {
  Object object = solid.object();
  object.moves = !deforms;
  object.deforms = deforms;
  return object;
}

std::vector<MovingCase> cases() {
  std::vector<MovingCase> list;
  std::uint64_t seed = 1;
  for (const Shape& shape : wandered_shapes()) {
    for (const double radius_m : {0.0, 0.001, 0.004}) {
      const double mu = seed % 2 == 0 ? 0.0 : 0.6;
      list.push_back({shape, shape.closed ? Sides::one : Sides::two, radius_m, mu, seed++});
      list.push_back({shape, Sides::two, radius_m, mu, seed++});
    }
  }
  return list;
}

class ChangingObject {
 public:
  ChangingObject(const MovingCase& c, bool deforms)
      : case_(c),
        solid_(
            c.shape, c.sides,
            {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(c.mu, 0.7 * c.mu)}),
        object_(changing(solid_, deforms)),
        tool_(std::make_unique<Wanderer>(solid_.shape(), c.seed)),
        random_(c.seed + 1000) {
    EXPECT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = c.radius_m}));
    world_->touch({.p_W = Wanderer::start()}, &path_);
  }

 protected:
  void expect_clear(double distance_m, MovingTally& tally) const {
    tally.worst_clearance_m = std::min(tally.worst_clearance_m, distance_m - case_.radius_m);
    ASSERT_GT(distance_m, 0.0) << "crosses a triangle";
    ASSERT_GE(distance_m, case_.radius_m - kMovingTolerance_m) << "cuts into a triangle";
  }
  [[nodiscard]] double reach_m() const { return case_.radius_m + 1e-5; }

  const MovingCase& case_;
  Solid solid_;
  Object object_;
  std::unique_ptr<Wanderer> tool_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> signed_unit_{-1.0, 1.0};
  ProxyPath path_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

// Goes to and fro through some centimetres at up to 5 m/s, and turns at up to 40 rad/s.
class FlyingObject : public ChangingObject {
 public:
  explicit FlyingObject(const MovingCase& c) : ChangingObject(c, false) {}

  void tick(MovingTally& tally) {
    if (ticks_left_-- <= 0) {
      choose_motion();
    }
    const RigidPose before = pose_;
    const Vec3 from_O = before.point_in(last_proxy_W_);
    pose_.translation += step_m_ * direction_;
    if (pose_.translation.norm() > 0.05) {
      direction_ = -pose_.translation.normalized();
    }
    pose_.rotation = turn_ * pose_.rotation;
    orthonormalise();
    ASSERT_TRUE(world_->set_pose(0, pose_, {}));
    const Touch touch = world_->touch({.p_W = tool_->next()}, &path_);
    tally.contacts += touch.planes > 0 ? 1 : 0;
    ASSERT_EQ(touch.flags & rendering::kTouchPinched, 0U);
    Vec3 at_O = from_O;
    for (std::size_t k = 0; k < path_.count; ++k) {
      const Vec3 to_O = pose_.point_in(path_.points[k]);
      ASSERT_NO_FATAL_FAILURE(expect_clear(clearance(corners_, at_O, to_O, reach_m()), tally));
      at_O = to_O;
    }
    last_proxy_W_ = touch.proxy_W;
  }

 private:
  void choose_motion() {
    ticks_left_ = 20;
    step_m_ = std::pow(10.0, -6.0 + 3.7 * std::abs(signed_unit_(random_)));
    const double turn_rad = 0.04 * std::pow(signed_unit_(random_), 3);
    turn_ = Eigen::AngleAxisd(turn_rad, random_direction()).toRotationMatrix();
    direction_ = random_direction();
  }
  Vec3 random_direction() {
    return Vec3(signed_unit_(random_), signed_unit_(random_), signed_unit_(random_) + 0.01)
        .normalized();
  }
  void orthonormalise() {
    pose_.rotation = Eigen::Quaterniond(pose_.rotation).normalized().toRotationMatrix();
  }

  std::vector<Corners> corners_ = corners_of(solid_.shape());
  RigidPose pose_;
  Vec3 last_proxy_W_ = Wanderer::start();
  Vec3 direction_ = Vec3::UnitX();
  Mat3 turn_ = Mat3::Identity();
  double step_m_ = 0.0;
  int ticks_left_ = 0;
};

// A solid ripples by a smooth map of space, at up to half a metre a second, so that it stays a
// solid; of a sheet every vertex goes round a millimetre's circle of its own, through thick and
// thin.
class BoilingObject : public ChangingObject {
 public:
  explicit BoilingObject(const MovingCase& c) : ChangingObject(c, true), shape_(solid_.shape()) {
    for (std::size_t i = 0; i < shape_.vertices.size(); ++i) {
      phase_.push_back(3.14 * signed_unit_(random_));
    }
  }

  void tick(MovingTally& tally) {
    const Shape before = shape_;
    const Vec3 from = path_.points[path_.count - 1];
    boil();
    const Touch touch = world_->touch({.p_W = tool_->next()}, &path_);
    tally.contacts += touch.planes > 0 ? 1 : 0;
    // Two sheets of the mesh that close on the proxy from both sides leave it nowhere to go.
    if ((touch.flags & rendering::kTouchPinched) != 0) {
      ++tally.pinched;
      world_->reset();
      path_.points[0] = Wanderer::start();
      path_.count = 1;
      tool_ = std::make_unique<Wanderer>(solid_.shape(), case_.seed + tally.pinched);
      world_->touch({.p_W = Wanderer::start()}, &path_);
      return;
    }
    ASSERT_NO_FATAL_FAILURE(check_all_through(before, from, path_.points[0], tally));
    const std::vector<Corners> corners = corners_of(shape_);
    for (std::size_t k = 0; k + 1 < path_.count; ++k) {
      ASSERT_NO_FATAL_FAILURE(
          expect_clear(clearance(corners, path_.points[k], path_.points[k + 1], reach_m()), tally));
    }
  }

 private:
  [[nodiscard]] Vec3 offset(std::size_t i) const {
    const Vec3 rest = to_vec3(solid_.shape().vertices[i]);
    if (case_.sides == Sides::one) {
      const double angle = 0.5 * ticks_;
      return 0.001 * Vec3(std::sin(60 * rest.y() + angle), std::sin(70 * rest.z() + 0.7 * angle),
                          std::sin(80 * rest.x() + 0.3 * angle));
    }
    const double angle = phase_[i] + 0.1 * (1.0 + std::sin(phase_[i])) * ticks_;
    return 0.001 * Vec3(std::cos(angle), std::sin(angle), std::sin(angle + phase_[i]));
  }

  void boil() {
    ++ticks_;
    const double fade_in = std::min(1.0, 0.01 * ticks_);
    for (std::uint32_t i = 0; i < shape_.vertices.size(); ++i) {
      const Vec3 p = to_vec3(solid_.shape().vertices[i]) + fade_in * offset(i);
      ASSERT_TRUE(world_->move_vertex(0, i, p));
      shape_.vertices[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                            static_cast<float>(p.z())};
    }
  }

  // The vertices and the proxy go straight, side by side, while the objects move.
  void check_all_through(const Shape& before, const Vec3& from, const Vec3& to,
                         MovingTally& tally) {
    constexpr int kMoments = 4;
    Shape between = shape_;
    for (int moment = 1; moment <= kMoments; ++moment) {
      const double s = static_cast<double>(moment) / kMoments;
      for (std::size_t i = 0; i < shape_.vertices.size(); ++i) {
        const Vec3 p = (1.0 - s) * to_vec3(before.vertices[i]) + s * to_vec3(shape_.vertices[i]);
        between.vertices[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                               static_cast<float>(p.z())};
      }
      const Vec3 p = (1.0 - s) * from + s * to;
      ASSERT_NO_FATAL_FAILURE(expect_clear(clearance(corners_of(between), p, p, reach_m()), tally));
    }
  }

  Shape shape_;
  std::vector<double> phase_;
  int ticks_ = 0;
};

template <class Changing>
void wander(std::size_t ticks_in_all) {
  const std::vector<MovingCase> all = cases();
  const std::size_t ticks = ticks_in_all / all.size() + 1;
  MovingTally tally;
  for (const MovingCase& c : all) {
    Changing object(c);
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      SCOPED_TRACE(c.shape.name + " radius " + std::to_string(c.radius_m) + " seed " +
                   std::to_string(c.seed) + " tick " + std::to_string(tick));
      object.tick(tally);
      if (::testing::Test::HasFatalFailure()) {
        return;
      }
    }
  }
  std::printf("%zu ticks on %zu cases, %zu in contact, %zu pinched; least clearance %.3f um\n",
              ticks * all.size(), all.size(), tally.contacts, tally.pinched,
              1e6 * tally.worst_clearance_m);
  if (ticks >= kTicksToMeetEveryMover) {
    EXPECT_GT(tally.contacts, ticks * all.size() / 20);
  }
  EXPECT_LT(tally.pinched, ticks * all.size() / 100);
}

TEST(MovingObject, NeverSwallowsTheProxy) {
  wander<FlyingObject>(share_of(std::size_t{300'000}));
}

TEST(DeformingObject, NeverSwallowsTheProxy) {
  wander<BoilingObject>(share_of(std::size_t{50'000}));
}

}  // namespace
}  // namespace tactus::testing
