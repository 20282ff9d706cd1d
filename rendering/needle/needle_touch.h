// The needle of one tool: the entry to this folder. It goes through the layers of a scene in the
// order in which its axis enters them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/limits.h"
#include "rendering/needle/needle_energy.h"
#include "rendering/needle/needle_layer.h"
#include "rendering/needle/needle_tip.h"
#include "rendering/needle/tissue.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// Returns true if a needle may pierce the object: a rigid mesh or primitive, and no body.
bool may_be_pierced(const Object& object);

// Returns true if the needle and all tissues are valid(), and if every object with a tissue names
// one that is there, alone, and may_be_pierced().
bool valid(const NeedleScene& needle, std::span<const Object> objects);

// The force on the hand, N, world frame, and its parts.
struct NeedleForce {
  Vec3 force_W = Vec3::Zero();
  // The part of the friction on the shaft.
  Vec3 friction_W = Vec3::Zero();
  // The power to the hand by layers that move by themselves, W.
  double driven_power = 0.0;
  // The depth by which the surface in front of the tip is pressed in, m.
  double depth_m = 0.0;
  // The innermost layer that the tip has met, kNoObject for none.
  std::uint32_t object = kNoObject;
  // The friction of that layer on the shaft.
  FrictionState friction = FrictionState::free;
  // The number of layers that the needle is in, and true if it has overlapped one since the start.
  std::uint16_t layers = 0;
  bool has_left_out = false;
};

// One thread owns it; it has no heap. The scene must stay the same until start().
class NeedleTouch {
 public:
  // Starts over, out of all layers, with a scene that is valid().
  void start(const SceneObjects& scene, const NeedleScene& needle);
  // Forgets channels and contacts; the next advance() begins where the tool is.
  void reset() { is_placed_ = false; }

  // Returns true if there are a needle and tissue.
  [[nodiscard]] bool any() const { return count_ > 0; }

  // Returns the direction in which the needle pierces.
  [[nodiscard]] const Vec3& axis_W() const { return scene_.needle.axis_W; }

  // Moves the tip to the tool, whose numbers are finite, and returns the force. Real time: bounded
  // time that grows with the layers.
  NeedleForce advance(const SceneObjects& scene, const ToolState& tool);

  // Returns the account since the start, and the energy in the springs now, J.
  [[nodiscard]] const NeedleEnergy& energy() const { return energy_; }
  [[nodiscard]] double stored_J() const;
  // Returns true if the needle has met the object.
  [[nodiscard]] bool touches(std::uint32_t object) const;
  // Returns the layers, in the order of their objects, and the number of the object of each.
  [[nodiscard]] std::span<const NeedleLayer> layers() const {
    return std::span(layers_).first(count_);
  }
  [[nodiscard]] std::uint32_t object_of(std::size_t layer) const { return objects_[layer]; }

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive);

 private:
  // The layers that the tip has met, from the outermost to the innermost.
  struct Order {
    std::array<std::uint8_t, kMaxTissues> layers{};
    std::size_t count = 0;
    // The place of the first that is pressed in; `count` for none.
    std::size_t pressed = 0;
  };

  // The part of the shaft in a layer: how far behind the tip it begins and ends, m.
  struct Stretch {
    double near_m = 0.0;
    double far_m = 0.0;
  };
  // The energy that a puncture has to give, J, and the force that it took away, N.
  struct Recoil {
    double available_J = 0.0;
    double most_N = 0.0;
    // The length by which the needle springs forward, m; 0 before the first puncture of a tick.
    double length_m = 0.0;
    // The layers that the tick has looked at, a bit each.
    std::uint32_t tried = 0;
  };

  // Returns the needle in the frame of a layer's object.
  [[nodiscard]] NeedlePose pose_in(const SceneObjects& scene, std::size_t layer,
                                   const Vec3& tip_W) const;
  [[nodiscard]] const Tissue& tissue_of(std::size_t layer) const;
  void place(const SceneObjects& scene, const Vec3& tip_W);
  // Follows the motion of the tip through the surfaces.
  void follow(const SceneObjects& scene, const Vec3& tip_W);
  // Sorts the layers that the tip has met along the axis.
  [[nodiscard]] Order order() const;
  void find_pressed(Order& order) const;
  [[nodiscard]] Stretch stretch_of(const Order& order, std::size_t place) const;
  // Returns the force of a layer's surface that is pressed in, N.
  [[nodiscard]] double membrane_N(std::size_t layer) const;
  // Meets the next layer in which the tip is, if the tip presses on none. Returns false if
  // there is none.
  bool meet_next(const SceneObjects& scene, const Vec3& tip_W, Recoil& recoil, Order& order);
  // Meets layers, and lets the surfaces give way whose force is exceeded; returns true if there is
  // one.
  bool puncture(const SceneObjects& scene, const Vec3& tip_W, Order& order);
  void pierce(Order& order, Recoil& recoil);
  void crack(const Tissue& tissue, double length_m, Recoil& recoil);
  static void load_shaft(const Tissue& tissue, double length_m, NeedleLayer& layer, Recoil& recoil);
  // Moves the tip, and returns its force with that of a surface that it presses in, N.
  double move_tip(const SceneObjects& scene, const Order& order, const ToolState& tool,
                  bool has_punctured);
  // Adds the force of one layer on the shaft.
  void hold_shaft(const SceneObjects& scene, const Order& order, std::size_t place,
                  const ToolState& tool, NeedleForce& force);

  NeedleScene scene_;
  // The object and the tissue of each layer.
  std::array<std::uint32_t, kMaxTissues> objects_{};
  std::array<std::uint8_t, kMaxTissues> tissues_{};
  std::size_t count_ = 0;
  std::array<NeedleLayer, kMaxTissues> layers_{};
  // The crossings of each layer's surface in this tick.
  std::array<SurfaceCrossing, kMaxTissues> crossings_{};
  NeedleTip tip_;
  NeedleEnergy energy_;
  bool is_placed_ = false;
};

}  // namespace tactus::rendering
