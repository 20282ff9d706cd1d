// The sphere proxy: the god-object of Zilles and Salisbury (IROS 1995) with a radius, after
// Ruspini, Kolarov and Khatib ("The haptic display of complex graphical environments", SIGGRAPH
// 1997). Radius 0 is the god-object point.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "rendering/contact/candidate_set.h"
#include "rendering/contact/carry_along.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/friction/surface_friction.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/limits.h"
#include "rendering/state/state_archive.h"
#include "rendering/world/scene_objects.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

// The straight moves of one tick, for tests and pictures: points[0] to points[count - 1], world
// frame, metres.
struct ProxyPath {
  std::array<Vec3, kMaxSubGoals + 1> points;
  std::size_t count = 0;
};

// One surface that holds the proxy.
struct ContactPlane {
  Plane plane;      // world frame; the centre must stay on its positive side
  Nearest nearest;  // of its triangle, at the proxy
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;  // of the object's mesh
  std::size_t candidate = 0;
};

// Where the proxy came to rest.
struct ProxyRest {
  Vec3 normal_W = Vec3::Zero();  // unit, of the joint push of the planes; zero in free space
  std::array<ContactPlane, 3> planes{};  // those that push
  std::array<double, 3> pressure_m{};    // how far each pushes
  std::uint8_t plane_count = 0;
  std::uint16_t sub_goals = 0;
  std::uint32_t flags = kTouchClean;

  // The plane that pushes hardest, of plane_count > 0.
  [[nodiscard]] std::size_t hardest() const {
    const auto end = pressure_m.begin() + plane_count;
    return static_cast<std::size_t>(std::max_element(pressure_m.begin(), end) - pressure_m.begin());
  }
};

// What friction is told beside the materials: factors of the coefficients of some objects, and, if
// the goal is not as deep as the tool, how deep that is.
struct FrictionFactors {
  std::array<std::uint32_t, 3> object{};
  std::array<double, 3> factor{};
  std::size_t count = 0;
  double depth_m = 0.0;  // 0: the goal's

  [[nodiscard]] double of(std::uint32_t number) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (object[i] == number) {
        return factor[i];
      }
    }
    return 1.0;
  }
};

class SphereProxy {
 public:
  explicit SphereProxy(double tool_radius_m) : margins_(tool_radius_m) {}

  // Takes another radius, >= 0; call place() afterwards.
  void set_tool_radius(double tool_radius_m) { margins_ = ContactMargins(tool_radius_m); }

  // Starts over, out of contact, at p_W. No triangle is asked.
  void place(const Vec3& p_W);

  // First in every tick, once the objects are where they are now: those that moved take the proxy
  // along or push it. TouchFlags; bounded work, no heap.
  std::uint32_t begin_tick(const SceneObjects& scene);

  // Next, what friction models are driven by: the tool's step since the last tick, in the world's
  // frame, and how long it took.
  void begin_friction(const Vec3& tool_step_W, double tick_s);

  // Moves the proxy as near to the tool as surfaces and friction let it, for a tool at h_W
  // (finite). Bounded work, no heap. `path`, if given, receives the moves.
  ProxyRest advance(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);

  // The last advance once more, from where that began, toward another goal: so that friction holds
  // what came of it, and not of the try before. The work of both counts for the tick.
  ProxyRest advance_again(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);

  // Last in a tick.
  void look_ahead(const SceneObjects& scene) {
    candidate_set_.look_ahead(scene, margins_, p_, p_ + kFarther * (p_ - start_));
  }

  // Whether the tick's work leaves room for another.
  [[nodiscard]] bool can_advance_again() const { return candidate_set_.budget().can_repeat(); }

  // From now on; all 1 and 0 at the start.
  void set_friction_factors(const FrictionFactors& factors) { factors_ = factors; }

  [[nodiscard]] const Vec3& position_W() const { return p_; }
  [[nodiscard]] FrictionState friction() const { return friction_; }
  [[nodiscard]] std::size_t peak_candidates() const { return candidate_set_.peak(); }

  // What it remembers, to bytes or back; of the same scene.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // A sphere that overlaps a surface by at most this, by rounding or by what deforms, is put right
  // in one tick. An object that it overlaps by more is left out until the sphere is clear of it.
  static constexpr double kMostPushOut_m = 20e-6;

  // The next tick's move, of this tick's.
  static constexpr double kFarther = 1.5;

  struct Goal {
    Vec3 point = Vec3::Zero();
    bool settled = false;
    bool stretched = false;  // the move was lengthened
  };
  // What held the proxy at its last sub-goal in this tick.
  struct LastConstraints {
    std::array<std::size_t, 3> candidates{};
    std::size_t count = 0;
    Vec3 from = Vec3::Zero();

    void take(const ProxyRest& rest, std::size_t planes, const Vec3& p) {
      count = planes;
      from = p;
      for (std::size_t i = 0; i < planes; ++i) {
        candidates[i] = rest.planes[i].candidate;
      }
    }
  };
  // What the proxy's centre moves on, where that is no plane.
  struct Curvature {
    double ratio = 0.0;                 // of one move to the next; 0 if it is flat, or not known
    Vec3 part = Vec3::Zero();           // of the move that changes by it
    double max_share_of_radius = 0.25;  // how far a move may be lengthened
  };
  static constexpr std::size_t kNoCandidate = static_cast<std::size_t>(-1);
  struct Segment {
    Sweep sweep;
    double length = 0.0;  // m
    Vec3 end = Vec3::Zero();
  };
  struct SweepResult {
    Vec3 direction = Vec3::Zero();          // unit
    double travel = 0.0;                    // m
    bool arrived = false;                   // the whole way was free
    bool is_known = false;                  // and the candidates tell what is where it ends
    std::size_t blocked_by = kNoCandidate;  // the candidate that stopped it at once
  };

  struct Move {
    Goal goal;
    SweepResult sweep;  // there, unless it is settled
  };

  ProxyRest approach(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);
  ProxyRest run_sub_goals(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);
  // As far as that goes: among too many triangles to know what holds the proxy it cannot slide, but
  // it can leave.
  void sweep_to_tool(const SceneObjects& scene, const Vec3& h_W);
  Move find_move(const SceneObjects& scene, const Vec3& h_W, double most_push, ProxyRest& rest);
  // Which objects are felt in this tick.
  void update_left_out(const SceneObjects& scene);
  // Starts the tick's search again without the objects that were left out in it.
  bool leave_out_overlapped(const SceneObjects& scene, ProxyRest& rest);
  void sweep_to_tool_if_allowed(const SceneObjects& scene, const Vec3& h_W, ProxyRest& rest,
                                ProxyPath* path);
  void forget_left_out(ProxyRest& rest);
  [[nodiscard]] bool overlaps(const Candidate& candidate) const;
  // Where more planes hold the sphere than are kept, and none of its moves is free: straight to
  // the tool, if that is.
  void escape_overfull_planes(const SceneObjects& scene, const Vec3& h_W, ProxyRest& rest);
  // False if the tick's work is done before all are measured that are near.
  bool collect_planes(const SceneObjects& scene, double most_push, ProxyRest& rest);
  void add_face_below(const SceneObjects& scene, ProxyRest& rest);
  [[nodiscard]] bool would_cycle(const Vec3& goal, const Vec3& h) const;
  // True if any of it is new.
  bool recall_last_constraints();
  [[nodiscard]] bool has_plane(std::size_t i) const;
  void add_recalled_planes(const SceneObjects& scene, double most_push, ProxyRest& rest);
  // True if the plane of candidate i is new.
  bool add_plane(std::size_t i, double most_push, ProxyRest& rest);
  [[nodiscard]] bool is_blocking(std::size_t i) const;
  bool add_blocking_plane(std::size_t i, double most_push, ProxyRest& rest);
  PlaneProjection project(const Vec3& h);
  [[nodiscard]] Vec3 resting_position();
  struct ActiveConstraints {
    PlaneProjection projection;
    FrictionCircle circle;
    double push_m = 0.0;
    bool in_cone = true;
  };
  ActiveConstraints active_constraints(const SceneObjects& scene, const Vec3& h, ProxyRest& rest);
  void keep_last_contact(const SceneObjects& scene, const Vec3& h, ProxyRest& rest) const;
  Goal choose_goal(const SceneObjects& scene, const Vec3& h, ProxyRest& rest);
  Goal goal_by_friction_circle(const PlaneProjection& projection, const FrictionCircle& circle,
                               const Vec3& h, const ProxyRest& rest);
  Goal goal_by_friction_model(const SceneObjects& scene, const PlaneProjection& projection,
                              const Vec3& h, const ProxyRest& rest, double push_m);
  Goal goal_along_surface(const Vec3& goal, const Vec3& h, const ProxyRest& rest);
  Vec3 follow_curvature(const Vec3& move, const Vec3& h, const ProxyRest& rest);
  [[nodiscard]] Curvature curvature_at_feature(const Vec3& move, const Vec3& h,
                                               const ProxyRest& rest) const;
  [[nodiscard]] Curvature curvature_along_crease(const Vec3& move, const ProxyRest& rest) const;
  [[nodiscard]] bool is_still_on_face(const SceneObjects& scene, const ProxyRest& rest);
  class CandidateSweep;
  SweepResult sweep_toward(const SceneObjects& scene, const Vec3& goal, const ProxyRest& rest);
  // The free part of the way, by no more work than that.
  double sweep_objects(const SceneObjects& scene, const Sweep& sweep, double length,
                       std::size_t max_cost);

  ContactMargins margins_;
  Vec3 p_ = Vec3::Zero();
  FrictionState friction_ = FrictionState::free;
  SurfaceFriction model_;
  SurfaceFriction start_model_;    // of the last advance
  Vec3 carried_W_ = Vec3::Zero();  // by objects that moved, since the last begin_friction
  LastContact last_contact_;       // what pushed hardest when it was last held
  FrictionFactors factors_;
  Vec3 start_ = Vec3::Zero();  // of the last advance
  FrictionState start_friction_ = FrictionState::free;
  LastContact start_last_contact_;
  bool slipped_ = false;                  // in this tick
  Vec3 last_crease_move_ = Vec3::Zero();  // in this tick, unless it was lengthened
  // To the tool, after the moves on one and on two planes that were lengthened in this tick.
  std::array<double, 2> least_left_m_{};
  CandidateSet candidate_set_;
  std::array<ContactPlane, kMaxContactPlanes> contacts_;
  std::size_t contact_count_ = 0;
  std::array<Plane, kMaxContactPlanes> planes_;  // the same, for a projection
  LastConstraints last_constraints_;
  std::array<std::size_t, 6> recalled_{};  // candidates that give their planes from afar
  std::size_t recalled_count_ = 0;
  bool just_placed_ = true;         // no tick since it was placed
  bool found_overlap_ = false;      // an object was left out in this sub-goal
  bool above_first_plane_ = false;  // above its first plane, in this sub-goal
  std::array<std::size_t, kMaxContactPlanes>
      blocking_candidates_{};  // candidates that stopped a sweep in this tick
  std::size_t blocking_count_ = 0;
};

}  // namespace tactus::rendering
