// Plans the trusted capsules: where, how long and how slim the next one is.
//
// The capsule's length is chosen so that gathering looks at about kWantedTests triangles: a
// gathering then lasts for many ticks on a coarse mesh and for few on a fine one. The values were
// tuned on the median and the slowest ticks of a 2 mm sphere on a fine sphere and on the dragon.
#pragma once

#include <cstddef>

#include "rendering/geometry/capsule.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// Its memory lives from tick to tick; CandidateSet has one.
class CapsulePlan {
 public:
  // Returns the capsule of the next gathering, which starts at p. It extends in the direction in
  // which the proxy moved since the last gathering, which started at `last_start` (world frame, m).
  // After the proxy left through the side the next capsule is less slim; after it left through the
  // end, slimmer.
  // `again` says that it is not the first gathering of the tick: the proxy has far to go, so the
  // capsule is the stoutest, and longer.
  Capsule next(const Vec3& last_start, const Vec3& p, bool again = false);

  // Learns the length of the next capsule from a gathering that tested so many triangles. `lasted`
  // says that it is the first since the tick began, so that the capsule before lasted a tick.
  void learn(std::size_t tested, bool lasted);

  // Halves the length, for want of room for candidates.
  void halve() { length_m_ *= 0.5; }
  // Limits the length to what suits a dense place.
  void limit();
  // Sets the least length: the proxy may come out of free space onto any mesh.
  void shorten();

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // The length of the next capsule's axis, m.
  double length_m_ = 0.0;
  // The capsule's radius is its length over this.
  double slimness_ = 1.0;
};

}  // namespace tactus::rendering
