// Lets a program see how a tick comes to its result: for explanations, pictures and tests. A tick
// without a watcher computes the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/contact/feature_walk.h"
#include "rendering/contact/next_move.h"
#include "rendering/contact/textbook/first_facet.h"
#include "rendering/contact/tick_watch.h"
#include "rendering/limits.h"
#include "rendering/surface/implicit_surface.h"
#include "rendering/touch.h"

namespace tactus::rendering {

struct Mover;
struct Object;

// The steps of a haptic loop, in the lecture's order (CS 277, lecture 5). A tick takes steps 3 and
// 4 once for every sub-goal, and moves the objects before the contacts.
enum class TickStep : std::uint8_t {
  read,       // 1: reads the position of the device
  tool,       // 2: updates the segment from the proxy to the tool
  collision,  // 3: searches for collisions along the segment
  proxy,      // 4: updates the position of the proxy
  force,      // 5: computes the force
  command,    // 6: sends the force to the device
  objects,    // 7: moves the objects
};
inline constexpr std::size_t kTickStepCount = 7;

// The object of an independent contact.
struct WatchedObject {
  // The number of the object in the scene, and the object itself.
  std::uint32_t number = 0;
  const Object* object = nullptr;
  // The object's place if it moves; nullptr if it is fixed.
  const Mover* mover = nullptr;
};

// A sub-goal of the shared proxy, chosen and swept but not moved to yet.
struct WatchedSubGoal {
  // The tick's goal, and the proxy with its planes, its active planes and its friction.
  const ProxyMove& tick;
  const MovingProxy& proxy;
  const NextMove& move;
  // True if the proxy was put back to an earlier place of this tick, whose contact is found again.
  bool is_put_back;
};

// A sub-goal of the proxy of an implicit surface, after its move. Positions are in the object's
// frame, in the formula's unit of length.
struct WatchedFormulaStep {
  const ImplicitSurface& surface;
  // The sign of f on the side where the proxy is: F = side * f. It is 0 where it is not known.
  double side;
  // The proxy before the move, its goal, and the proxy after it.
  Vec3 from_O;
  Vec3 goal_O;
  Vec3 to_O;
  // The number of tangent planes that hold the proxy, and the state of its friction.
  std::uint8_t planes;
  FrictionState friction;
  // TouchFlags so far.
  std::uint32_t flags;
};

// A segment of a textbook's proxy on a mesh, after its move. Frame of the object, m.
struct WatchedSegment {
  Vec3 from_O;
  Vec3 goal_O;
  Vec3 to_O;
  Vec3 tool_O;
  // The facet that the segment crosses, if any.
  FacetHit hit;
};

// Receives the steps of ticks in their order. What it is given is valid during the call. It must
// not change the world.
class TickWatcher {
 public:
  TickWatcher(const TickWatcher&) = delete;
  TickWatcher& operator=(const TickWatcher&) = delete;

  // A part of `step` has ended; it began at the last call of any of these functions. The first call
  // of a touch is that of TickStep::tool, where the touch begins; of several tools it also comes
  // where the work for others ends, which is no step of this one. A clock may be read here, because
  // no result of the tick depends on it.
  virtual void see_step(TickStep step) = 0;
  // A sub-goal of the shared proxy is chosen.
  virtual void see(const WatchedSubGoal& sub_goal) = 0;
  // The shared proxy has ended its moves toward a goal; shading may give it another one in the same
  // tick.
  virtual void see_end(const MovingProxy& proxy, bool is_put_back) = 0;
  // A sub-goal on the implicit surface of `object` has ended.
  virtual void see(const WatchedObject& object, const WatchedFormulaStep& step) = 0;
  // The feature walk on the mesh of `object` has ended its tick at this feature.
  virtual void see(const WatchedObject& object, const MeshFeature& feature) = 0;
  // The textbook's proxy on the mesh of `object` has tested a segment.
  virtual void see(const WatchedObject& object, const WatchedSegment& segment) = 0;

 protected:
  TickWatcher() = default;
  ~TickWatcher() = default;
};

// The watch of an object in a tick that a watcher sees.
class ObjectWatched {
 public:
  static constexpr bool kSees = true;

  ObjectWatched(TickWatcher& watcher, const WatchedObject& object)
      : watcher_(watcher), object_(object) {}

  // Shows a WatchedFormulaStep, a MeshFeature or a WatchedSegment.
  template <class Step>
  void see(const Step& step) const {
    watcher_.see(object_, step);
  }

 private:
  TickWatcher& watcher_;
  WatchedObject object_;
};

// The watch of a tick that a watcher sees.
class Watched {
 public:
  explicit Watched(TickWatcher& watcher) : watcher_(watcher) {}

  void see_step(TickStep step) const { watcher_.see_step(step); }
  void see(const WatchedSubGoal& sub_goal) const { watcher_.see(sub_goal); }
  void see_end(const MovingProxy& proxy, bool is_put_back) const {
    watcher_.see_end(proxy, is_put_back);
  }
  [[nodiscard]] ObjectWatched of(const WatchedObject& object) const { return {watcher_, object}; }

 private:
  TickWatcher& watcher_;
};

// The places that the shared proxy reached in a tick's last advance, for tests and pictures:
// points[0] to points[count - 1], world frame, m.
class ProxyPath final : public TickWatcher {
 public:
  void see_step(TickStep /*step*/) override {}
  void see(const WatchedSubGoal& sub_goal) override { add(sub_goal.proxy, sub_goal.is_put_back); }
  void see_end(const MovingProxy& proxy, bool is_put_back) override { add(proxy, is_put_back); }
  void see(const WatchedObject& /*object*/, const WatchedFormulaStep& /*step*/) override {}
  void see(const WatchedObject& /*object*/, const MeshFeature& /*feature*/) override {}
  void see(const WatchedObject& /*object*/, const WatchedSegment& /*segment*/) override {}

  std::array<Vec3, kMaxSubGoals + 1> points;
  std::size_t count = 0;

 private:
  // The path ends where the proxy has been farthest, not where it was put back.
  void add(const MovingProxy& proxy, bool is_put_back) {
    if (!is_put_back) {
      points[proxy.rest.sub_goals] = proxy.state.p_W;
      count = proxy.rest.sub_goals + std::size_t{1};
    }
  }
};

}  // namespace tactus::rendering
