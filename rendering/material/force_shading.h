// Force shading in two passes (Ruspini, Kolarov and Khatib, "The haptic display of complex
// graphical environments", SIGGRAPH 1997): the proxy goes to its place on the interpolated planes,
// and from there to the real ones, which alone decide where it may be.
//
// Here the first pass gives the second a goal. Let the proxy p rest on a plane of the normal n,
// with the tool h at the depth d = (p - h) . n, and let the interpolated normal be m. The two
// passes come to rest when p - h is parallel to m: at p = h + G, G = d m / (m . n). The second pass
// is given the goal
//
//   g = h + G - d n
//
// which is h shifted along the plane: depth and friction stay what they were, and as the proxy
// moves on real planes only, it crosses nothing. With several planes each shifts as hard as it
// pushes.
//
// m depends on where the proxy rests, so G is found by iteration: on a surface of the curvature k
// each pass leaves d k of the error. Beyond 1, as in the grooves of a bump, plain iteration would
// swing from wall to wall without end; so only a share of each step is taken (relaxation.h), and
// the proxy comes to rest in the groove. Where no G exists, as on an edge between two faces that
// lean the force each toward the other, the iteration ends when the tool has been at rest for a
// while; the proxy then goes to a goal that no longer moves.
//
// A sphere that rolls over an edge holds still on it only while its goal is nearer than the edge's
// rounding, its radius. So on interpolated planes the goal of a deep tool is lifted toward the
// proxy, to a depth D < d: g = h + G - D n, as the second pass of the paper starts from the
// surface. Friction then uses the tool's depth.
#pragma once

#include "rendering/geometry/vector.h"
#include "rendering/material/relaxation.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// A pass's outcome.
struct ShadedRest {
  // The direction of the joint push of the real planes, unit.
  Vec3 normal_W = Vec3::Zero();
  // G / d - n, which the detail asks for.
  Vec3 lean = Vec3::Zero();
  // (proxy - tool) . normal, m.
  double depth_m = 0.0;
  // True if one of the planes has interpolated normals.
  bool interpolated = false;
};

// The iteration for one proxy. World frame for the shared proxy, the object's frame for others.
//
// A tick: begin(), a pass toward tool + offset(), improve() with its outcome, and again while that
// returns true and the budget permits.
class ForceShading {
 public:
  // Takes the radius of the tool, >= 0, and forgets the contact.
  void set_tool_radius(double tool_radius_m);

  // Forgets the contact: the offset is zero.
  void reset();

  // The number of passes in a tick; with one, the iteration runs from tick to tick.
  enum class Passes : bool { one, several };

  // A tick begins with the proxy, the tool, and how far the tool has moved beside the surface since
  // the last tick; world frame, m.
  struct Start {
    const Vec3& proxy_W;
    const Vec3& tool_W;
    double moved_m;
  };
  // Begins a tick with what the last one came to, at the depth of its proxy now.
  void begin(const Start& start, Passes passes = Passes::several);

  // Takes a pass's outcome. Returns true if another pass with the new offset() pays.
  bool improve(const ShadedRest& rest);

  // Removes the lift until the next improve(). Returns false if there was none.
  bool lower();

  // Returns the offset from the tool to the proxy's goal; world frame, m.
  [[nodiscard]] const Vec3& offset() const { return offset_; }
  // Returns true if the goal is shifted.
  [[nodiscard]] bool is_on() const { return offset_ != Vec3::Zero(); }
  // Returns true if the tool has been at rest for so long that the goal is left as it is.
  [[nodiscard]] bool is_at_rest() const { return relaxation_.is_at_rest(); }
  // Returns the tool's depth (m) if the goal is lifted, else 0.
  [[nodiscard]] double lifted_from_m() const { return lifted_from_m_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // Sets the offset for a proxy at this depth, lifted if that is too deep.
  void set_offset(double depth_m);

  double tool_radius_m_ = 0.0;
  // n, the joint normal of the real planes after the last pass.
  Vec3 normal_ = Vec3::Zero();
  // G, the stretch that the force is to have; m.
  Vec3 stretch_ = Vec3::Zero();
  // d, the depth of the proxy that G is for; m.
  double depth_m_ = 0.0;
  // True if the planes are interpolated, so that a deep goal is lifted.
  bool interpolated_ = false;
  // The offset of the goal, and the depth from which it is lifted (0: it is not); m.
  Vec3 offset_ = Vec3::Zero();
  double lifted_from_m_ = 0.0;
  // The share of a step that is taken.
  Relaxation relaxation_;
};

// Returns m / (m . n) - n, with m turned toward n if it leans by more than 60 degrees. Both
// arguments are unit.
Vec3 lean_of(const Vec3& shading_normal, const Vec3& normal);

}  // namespace tactus::rendering
