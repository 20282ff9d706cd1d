// The god-object on meshes as the textbook has it, in four versions, each kept with its faults so
// that they can be felt and compared. World::touch uses it for the contact methods of the same
// names (rendering/world/independent_contacts.h), in the frame of the object. README.md in this
// folder shows every fault with its remedy; the controller's own methods have none of them.
//
// one_plane        Zilles and Salisbury as first taught: the first facet between the god-object and
//                  the tool is the one constraint, and the god-object goes to the nearest point of
//                  its plane, unchecked. At a convex edge that point is in the air for a tick; at a
//                  concave one it is behind the other face, which is then never felt.
// three_sub_goals  The same, repeated: the nearest point is a sub-goal. A facet before it becomes
//                  a further constraint, up to three (Zilles and Salisbury, "A constraint-based
//                  god-object method for haptic display", IROS 1995).
// three_step       Segment, project, segment, project, segment: the god-object moves to each
//                  collision point and the goal is projected on that facet's plane alone (CHAI3D's
//                  rule as the lecture gives it).
// one_step         The same rule with one segment a tick, as CHAI3D runs it by default: a slide
//                  alternates between the collision point and the goal.
//
// After each collision the god-object stands the push-out above the facet, so that the next tick
// finds the facet again. With a push-out of zero rounding decides, and it falls through. The
// push-out itself is not checked against other facets: it takes three_step and one_step through the
// other wall of a narrow slot, and of a groove of 60 degrees however small it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/contact/textbook/first_facet.h"
#include "rendering/contact/tick_watch.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/geometry/vector.h"
#include "rendering/material/material.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The four versions.
enum class TextbookRule : std::uint8_t { one_plane, three_sub_goals, three_step, one_step };

// The surface under a textbook's proxy.
struct TextbookSurface {
  const MeshView& mesh;
  Sides sides;
  // The friction coefficients are used as those of the friction cone, whatever the model.
  const Material& material;
  // The height above a facet where the god-object is put, m, >= 0.
  double push_out_m;
};

// The god-object's position after a tick.
struct TextbookRest {
  // The god-object, m: the tool without contact.
  Vec3 proxy = Vec3::Zero();
  // The unit normal of the first facet that holds it, toward its free side; zero without contact.
  Vec3 normal = Vec3::Zero();
  // (proxy - tool) . normal, m; 0 without contact.
  double depth_m = 0.0;
  FrictionState friction = FrictionState::free;
  // The number of facets that hold the god-object, and the number of segments tested.
  std::uint8_t planes = 0;
  std::uint8_t segments = 0;
  // The number of triangles measured.
  std::size_t visited = 0;
  // TouchFlags: iterations exhausted, tool invalid.
  std::uint32_t flags = kTouchClean;
};

// One god-object on one mesh. The tool is a point; its radius is not used.
class TextbookProxy {
 public:
  // Starts over, out of contact, at `p`, m.
  void place(const Vec3& p);

  // Moves the god-object toward the tool by the rule. A tool that is not finite or beyond
  // kWorldBound_m leaves it where it is, and so does a search that measures more than `most_visits`
  // triangles. Real time: no heap. `watch` sees the segments.
  template <class Watch = Unwatched>
  TextbookRest advance(TextbookRule rule, const TextbookSurface& surface, const Vec3& tool,
                       std::size_t most_visits, Watch watch = {});

  // Returns the god-object's position after the last tick, m.
  [[nodiscard]] const Vec3& position() const { return p_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // The search of one tick, and what it has found.
  template <class Watch>
  struct Tick;

  // Each follows one rule. They return the goal without friction, m.
  Vec3 follow_one_plane(auto& tick) const;
  Vec3 follow_sub_goals(auto& tick) const;
  Vec3 follow_three_steps(auto& tick) const;
  Vec3 follow_one_step(auto& tick);
  // Follows the rule of the tick.
  Vec3 follow(TextbookRule rule, auto& tick);

  Vec3 p_ = Vec3::Zero();
  FrictionState friction_ = FrictionState::free;
  // The planes whose collision point one_step has reached, the first `steps_`.
  std::array<Plane, 2> step_planes_;
  std::uint8_t steps_ = 0;
};

}  // namespace tactus::rendering
