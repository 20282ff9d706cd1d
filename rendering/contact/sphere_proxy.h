// The sphere proxy: the god-object of Zilles and Salisbury (IROS 1995) with a radius, after
// Ruspini, Kolarov and Khatib ("The haptic display of complex graphical environments", SIGGRAPH
// 1997). With radius 0 it is the god-object. sphere_proxy.cpp describes one tick.
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
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The sub-goals that the proxy reached in one tick, for tests and pictures: points[0] to
// points[count - 1], world frame, metres.
struct ProxyPath {
  std::array<Vec3, kMaxSubGoals + 1> points;
  std::size_t count = 0;
};

// One contact plane: a constraint on the proxy's centre.
struct ContactPlane {
  Plane plane;      // world frame; the centre must stay on its positive side
  Nearest nearest;  // of its triangle, at the proxy
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;  // of the object's mesh
  std::size_t candidate = 0;
};

// The proxy's contact after a tick.
struct ProxyRest {
  Vec3 normal_W = Vec3::Zero();  // unit, of the joint push of the planes; zero in free space
  std::array<ContactPlane, 3> planes{};  // those that push
  std::array<double, 3> pressure_m{};    // how far each pushes
  std::uint8_t plane_count = 0;
  std::uint16_t sub_goals = 0;
  std::uint32_t flags = kTouchClean;

  // Returns the index of the plane with the largest pressure. plane_count must be > 0.
  [[nodiscard]] std::size_t hardest() const {
    const auto end = pressure_m.begin() + plane_count;
    return static_cast<std::size_t>(std::max_element(pressure_m.begin(), end) - pressure_m.begin());
  }
};

// Factors of the friction coefficients of some objects, and the tool's depth (m) if the goal is not
// as deep as the tool. They come from textures and shading.
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

  // Sets the tool's radius, >= 0, m; call place() afterwards.
  void set_tool_radius(double tool_radius_m) { margins_ = ContactMargins(tool_radius_m); }

  // Places the proxy at p_W (world frame, m), out of contact, and resets the rest of its state. It
  // searches no triangle.
  void place(const Vec3& p_W);

  // Moves the proxy with the objects that moved since the last tick. Call it first in every tick,
  // when the objects are at their new places. Returns TouchFlags. Bounded time, no heap.
  std::uint32_t begin_tick(const SceneObjects& scene);

  // Sets the tool's step since the last tick (world frame, m) and its duration (s), which drive the
  // friction models. Call it after begin_tick.
  void begin_friction(const Vec3& tool_step_W, double tick_s);

  // Moves the proxy as near to the tool position h_W (world frame, m, finite) as surfaces and
  // friction allow. `path` receives the moves if it is not null. Bounded time, no heap.
  ProxyRest advance(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);

  // Repeats the last advance from the same start toward another goal. Friction takes the state of
  // the repetition only. The cost of both counts for the tick.
  ProxyRest advance_again(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);

  // Gathers candidates for the next tick if there is budget left. Call it last in a tick.
  void look_ahead(const SceneObjects& scene) {
    candidate_set_.look_ahead(scene, margins_, p_, p_ + kFarther * (p_ - start_));
  }

  // Returns true if the tick's budget allows one more advance_again.
  [[nodiscard]] bool can_advance_again() const { return candidate_set_.budget().can_repeat(); }

  // Sets the friction factors of the next advances. By default all factors are 1 and the depth is
  // 0.
  void set_friction_factors(const FrictionFactors& factors) { factors_ = factors; }

  [[nodiscard]] const Vec3& position_W() const { return p_; }
  [[nodiscard]] FrictionState friction() const { return friction_; }
  [[nodiscard]] std::size_t peak_candidates() const { return candidate_set_.peak(); }

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // A sphere that overlaps a surface by at most this, by rounding or by a deformation, is pushed
  // out in one tick. An object with a greater overlap is left out until the sphere is clear of it.
  static constexpr double kMostPushOut_m = 20e-6;

  // Estimates the next tick's move as this multiple of the current one.
  static constexpr double kFarther = 1.5;

  // The end of the next straight move.
  struct Goal {
    Vec3 point = Vec3::Zero();
    bool settled = false;
    bool stretched = false;  // the move was lengthened
  };
  // The active constraints at the previous sub-goal of this tick.
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
  // The curved surface on which the proxy's centre moves about an edge, a vertex or a crease.
  struct Curvature {
    double ratio = 0.0;                 // of one move to the next; 0 if it is flat, or not known
    Vec3 part = Vec3::Zero();           // of the move that changes by it
    double max_share_of_radius = 0.25;  // how far a move may be lengthened
  };
  static constexpr std::size_t kNoCandidate = static_cast<std::size_t>(-1);
  // A straight move to sweep.
  struct Segment {
    Sweep sweep;
    double length = 0.0;  // m
    Vec3 end = Vec3::Zero();
  };
  // The result of a sweep: the sphere may move toward the goal by `travel`.
  struct SweepResult {
    Vec3 direction = Vec3::Zero();          // unit
    double travel = 0.0;                    // m
    bool arrived = false;                   // the whole segment was free
    bool is_known = false;                  // the candidates are valid at its end
    std::size_t blocked_by = kNoCandidate;  // the candidate that blocked it at once
  };

  struct Move {
    Goal goal;
    SweepResult sweep;  // there, unless it is settled
  };

  // Moves the proxy and finds the contact of the tick.
  ProxyRest approach(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);
  // Repeats sub-goals until the proxy settles or a limit is reached.
  ProxyRest run_sub_goals(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path);
  // Sweeps straight to the tool. Among too many candidates the proxy cannot slide, but it can
  // leave.
  void sweep_to_tool(const SceneObjects& scene, const Vec3& h_W);
  // Chooses the next sub-goal and sweeps to it.
  Move find_move(const SceneObjects& scene, const Vec3& h_W, double most_push, ProxyRest& rest);
  // Updates the objects that are left out in this tick.
  void update_left_out(const SceneObjects& scene);
  // Leaves out the objects that the proxy overlaps too much. Returns true if there were any: then
  // the sub-goal must be started again.
  bool leave_out_overlapped(const SceneObjects& scene, ProxyRest& rest);
  void sweep_to_tool_if_allowed(const SceneObjects& scene, const Vec3& h_W, ProxyRest& rest,
                                ProxyPath* path);
  void forget_left_out(ProxyRest& rest);
  [[nodiscard]] bool overlaps(const Candidate& candidate) const;
  // Sweeps straight to the tool if more planes hold the sphere than are kept and no move along them
  // is free.
  void escape_overfull_planes(const SceneObjects& scene, const Vec3& h_W, ProxyRest& rest);
  // Collects the contact planes at the proxy. Returns false if the tick's budget is spent before
  // all near candidates are measured.
  bool collect_planes(const SceneObjects& scene, double most_push, ProxyRest& rest);
  // Adds the plane of a face a little below the sphere, if there is one.
  void add_face_below(const SceneObjects& scene, ProxyRest& rest);
  // Returns true if a move to `goal` would lead back to the previous sub-goal.
  [[nodiscard]] bool would_cycle(const Vec3& goal, const Vec3& h) const;
  // Makes the last active constraints give planes from any distance. Returns true if one is new.
  bool recall_last_constraints();
  [[nodiscard]] bool has_plane(std::size_t i) const;
  void add_recalled_planes(const SceneObjects& scene, double most_push, ProxyRest& rest);
  // Adds the plane of candidate i. Returns true if it is new.
  bool add_plane(std::size_t i, double most_push, ProxyRest& rest);
  // Returns true if candidate i stopped a sweep in this tick.
  [[nodiscard]] bool is_blocking(std::size_t i) const;
  bool add_blocking_plane(std::size_t i, double most_push, ProxyRest& rest);
  // Projects the tool on the contact planes.
  PlaneProjection project(const Vec3& h);
  // Returns the proxy's position at the rest height of its planes.
  [[nodiscard]] Vec3 resting_position();
  // The active contact planes and what friction needs of them.
  struct ActiveConstraints {
    PlaneProjection projection;
    FrictionCircle circle;
    double push_m = 0.0;
    bool in_cone = true;
  };
  ActiveConstraints active_constraints(const SceneObjects& scene, const Vec3& h, ProxyRest& rest);
  // Makes the contact of the last tick hold the proxy in a tick that found none.
  void keep_last_contact(const SceneObjects& scene, const Vec3& h, ProxyRest& rest) const;
  // Returns the sub-goal: the projection of the tool, held back by friction.
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
  // Sweeps against all objects for at most `max_cost` cost units. Returns the free travel, m.
  double sweep_objects(const SceneObjects& scene, const Sweep& sweep, double length,
                       std::size_t max_cost);

  ContactMargins margins_;
  Vec3 p_ = Vec3::Zero();
  FrictionState friction_ = FrictionState::free;
  SurfaceFriction model_;
  SurfaceFriction start_model_;    // of the last advance
  Vec3 carried_W_ = Vec3::Zero();  // by objects that moved, since the last begin_friction
  LastContact last_contact_;       // the plane with the largest pressure
  FrictionFactors factors_;
  Vec3 start_ = Vec3::Zero();  // of the last advance
  FrictionState start_friction_ = FrictionState::free;
  LastContact start_last_contact_;
  bool slipped_ = false;                  // in this tick
  Vec3 last_crease_move_ = Vec3::Zero();  // in this tick, unless it was lengthened
  // The least distances to the tool (m) after lengthened moves on one and on two planes in this
  // tick.
  std::array<double, 2> least_left_m_{};
  CandidateSet candidate_set_;
  std::array<ContactPlane, kMaxContactPlanes> contacts_;
  std::size_t contact_count_ = 0;
  std::array<Plane, kMaxContactPlanes> planes_;  // the same, for a projection
  LastConstraints last_constraints_;
  std::array<std::size_t, 6> recalled_{};  // candidates that give planes from any distance
  std::size_t recalled_count_ = 0;
  bool just_placed_ = true;         // no tick since it was placed
  bool found_overlap_ = false;      // an object was left out in this sub-goal
  bool above_first_plane_ = false;  // above its first plane, in this sub-goal
  std::array<std::size_t, kMaxContactPlanes>
      blocking_candidates_{};  // candidates that stopped a sweep in this tick
  std::size_t blocking_count_ = 0;
};

}  // namespace tactus::rendering
