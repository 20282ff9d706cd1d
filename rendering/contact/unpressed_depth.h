// The depth behind a surface that the hand has not pressed, and the spring of such a surface.
//
// Friction can hold the proxy on one surface while the tool comes to lie deep behind another one.
// When it lets go, the proxy slips to the second surface. If that one is stiffer, its whole spring
// would be stretched at once, with energy that no hand has put in. The same happens where the proxy
// passes from a surface to a stiffer one beside it. So what the pressure of a plane has grown
// without the hand, the depth u, counts at the stiffness k of the softest surface that held the
// proxy before, and the rest at the surface's own stiffness K. The force over the pressure p is
//
//   F(p) = k p for p <= u,   F(p) = k u + K (p - u) beyond
//
// u falls to p when the tool retreats. That leaves the stored energy as it is, so no cycle gives
// out energy, and a surface from which the tool has withdrawn is as stiff as ever.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/contact/last_contact.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/geometry/vector.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// The spring of one plane.
struct PlaneSpring {
  // The stiffness of the linear spring that holds the same energy at the plane's pressure, N/m.
  double stiffness_N_per_m = 0.0;
  // The force beyond that of the linear spring, N, along the plane's normal.
  double rise_N = 0.0;
};

// The proxy after a tick and the tool's motion in it; world frame, m.
struct ProxyStep {
  const Vec3& p_W;
  const Vec3& tool_step_W;
};

// The unpressed depths of the surfaces that hold one proxy.
class UnpressedDepths {
 public:
  // Returns the spring of the contact plane at that pressure, m. `stiffness_N_per_m` is the
  // surface's own.
  [[nodiscard]] PlaneSpring spring(const ContactPlane& contact, double pressure_m,
                                   double stiffness_N_per_m) const {
    return count_ == 0 ? PlaneSpring{.stiffness_N_per_m = stiffness_N_per_m}
                       : kept_spring(contact, pressure_m, stiffness_N_per_m);
  }

  // Ends a tick with the planes of `rest`.
  void end_tick(const SceneObjects& scene, const ProxyRest& rest, const ProxyStep& step);

  // Writes itself to the archive, or reads itself back; refused if a plane's object is not one of
  // the scene.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // A plane at the end of a tick.
  struct Plane {
    std::uint32_t object = kNoObject;
    Vec3 normal_W = Vec3::Zero();
    // The pressure p and the depth u, m.
    double pressure_m = 0.0;
    double depth_m = 0.0;
    // The stiffness k, N/m.
    double softer_N_per_m = 0.0;
    // The pressure's gradient over the stretch: the plane's vector of the dual basis, world frame.
    Vec3 dual_W = Vec3::Zero();

    // Returns the plane's spring at the pressure at_m. `stiffness_N_per_m` is the surface's own.
    [[nodiscard]] PlaneSpring spring(double at_m, double stiffness_N_per_m) const;
    // Takes the depth of the plane `before`, and adds the pressure that has grown beyond the one
    // that the stretch's growth `step_W`, m, accounts for.
    void add_unpressed(const Plane& before, const Vec3& step_W, double softest_N_per_m);
  };

  [[nodiscard]] PlaneSpring kept_spring(const ContactPlane& contact, double pressure_m,
                                        double stiffness_N_per_m) const;
  // Returns the plane of the contact's object with the most similar normal, nullptr if there is
  // none.
  [[nodiscard]] const Plane* find(const ContactPlane& contact) const;
  // Returns the stiffness of the softest surface, N/m; infinity if nothing holds the proxy.
  [[nodiscard]] double softest(const SceneObjects& scene) const;

  // The first count_ are kept while several objects hold the proxy, or a depth is left.
  std::array<Plane, 3> planes_{};
  std::size_t count_ = 0;
  // The object that holds the proxy alone, without a depth; kNoObject if there is none.
  std::uint32_t only_object_ = kNoObject;
};

}  // namespace tactus::rendering
