// The watch of a tick, through which its functions show their steps to a watcher. They take it as a
// template parameter and are compiled for each kind, so that a tick without a watcher has no
// instruction for one:
//
//   template <class Watch>
//   ProxyRest advance(const SceneObjects& scene, const Vec3& h_W, Watch watch);
//
// `Watch` is Unwatched or Watched; in what is computed for one object, Unwatched or ObjectWatched
// (both in tick_watcher.h).
#pragma once

#include <cstdint>
#include <type_traits>

namespace tactus::rendering {

enum class TickStep : std::uint8_t;
struct MovingProxy;
struct WatchedObject;
struct WatchedSubGoal;

// The watch of a tick that nobody sees, and of an object in it.
class Unwatched {
 public:
  // True of an object that somebody sees. What only a watcher needs is computed under this
  // condition.
  static constexpr bool kSees = false;

  static void see_step(TickStep /*step*/) {}
  static void see(const WatchedSubGoal& /*sub_goal*/) {}
  static void see_end(const MovingProxy& /*proxy*/, bool /*is_put_back*/) {}
  // Takes a WatchedFormulaStep, a MeshFeature or a WatchedSegment.
  template <class Step>
  static void see(const Step& /*step*/) {}
  // Returns the watch of what is computed for one object.
  static Unwatched of(const WatchedObject& /*object*/) { return {}; }
};
static_assert(std::is_empty_v<Unwatched>);

}  // namespace tactus::rendering
