// Force shading in two passes (Ruspini, Kolarov and Khatib, "The haptic display of complex
// graphical environments", SIGGRAPH 1997): the proxy goes to its place on the interpolated planes,
// and from there to the real ones, which alone decide where it may be.
//
// Here the first pass gives the second a goal. Where the proxy p rests on a plane of the normal n,
// with the tool h at the depth d = (p - h) . n, and the interpolated normal is m, the two passes
// come to rest when p - h is parallel to m: at p = h + G, G = d m / (m . n). The second pass is
// given the goal
//
//   g = h + G - d n
//
// which is h shifted along the plane: depth and friction stay what they were, and as the proxy
// moves on real planes only, it crosses nothing. With several planes each shifts as hard as it
// pushes.
//
// m depends on where the proxy rests, so G is found by iteration: on a surface of the curvature k
// each pass leaves d k of the error. Beyond 1, as in the grooves of a bump, plain iteration would
// swing from wall to wall without end; so each step is lengthened or shortened by what the one
// before it did (Irons and Tuck, IJNME 1(3), 1969), and the proxy comes to rest in the groove.
//
// A sphere that rolls over an edge holds still on it only while its goal is nearer than the edge's
// rounding, its radius. So on interpolated planes the goal of a deep tool is lifted toward the
// proxy, to a depth D < d: g = h + G - D n, as the second pass of the paper starts from the
// surface. Friction then uses the tool's depth.
#pragma once

#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// A pass's outcome.
struct ShadedRest {
  Vec3 normal_W = Vec3::Zero();  // unit, of the joint push of the real planes
  Vec3 lean = Vec3::Zero();      // G / d - n that the detail asks for
  double depth_m = 0.0;          // (proxy - tool) . normal
  bool interpolated = false;     // some plane is
};

class ForceShading {
 public:
  // Takes the radius of the tool, >= 0, and forgets the contact.
  void set_tool_radius(double tool_radius_m);

  // Forgets the contact: the offset is zero.
  void reset();

  // The number of passes in a tick; with one, the iteration runs from tick to tick.
  enum class Passes : bool { one, several };

  // Begins a tick with what the last one came to, at the depth of its proxy now. All are in the
  // world frame, metres.
  void begin(const Vec3& proxy_W, const Vec3& tool_W, Passes passes = Passes::several);

  // Takes a pass's outcome. Returns true if another pass with the new offset() pays.
  bool improve(const ShadedRest& rest);

  // Removes the lift until the next improve(). Returns false if there was none.
  bool lower();

  // Returns the offset from the tool to the proxy's goal; world frame, m.
  [[nodiscard]] const Vec3& offset() const { return offset_; }
  [[nodiscard]] bool is_on() const { return offset_ != Vec3::Zero(); }
  // Returns the tool's depth (m) if the goal is lifted, else 0.
  [[nodiscard]] double lifted_from_m() const { return lifted_from_m_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  void set_offset(double depth_m);

  double tool_radius_m_ = 0.0;
  Vec3 normal_ = Vec3::Zero();
  Vec3 stretch_ = Vec3::Zero();  // G
  double depth_m_ = 0.0;         // d, of the proxy that G is for
  bool interpolated_ = false;
  Vec3 offset_ = Vec3::Zero();
  double lifted_from_m_ = 0.0;
  Vec3 residual_ = Vec3::Zero();  // of the pass before in this tick
  bool has_residual_ = false;
  double relaxation_ = 1.0;
};

// Returns m / (m . n) - n, with m turned toward n if it leans by more than 60 degrees. Both
// arguments are unit.
Vec3 lean_of(const Vec3& shading_normal, const Vec3& normal);

}  // namespace tactus::rendering
