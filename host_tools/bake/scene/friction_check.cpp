// A bristle that sticks is a virtual wall with the stiffness sigma0 and the damping B + sigma1 N. B
// is the contact's damping; the normal force N ranges from 0 to its largest value. The stable
// dampings of a given stiffness form an interval, and so do the stable stiffnesses of a given
// damping. The two ends of the range are therefore enough to check.
#include "host_tools/bake/scene/friction_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_tools/input_error.h"
#include "rendering/friction/lugre_passivity.h"
#include "rendering/friction/sampled_device.h"

namespace tactus::host {
namespace {

using rendering::FrictionParameters;
using rendering::SampledDevice;

// Advice is rounded to five digits towards the safe side, so that the advised number is itself
// within the bound.
double last_digit(double value) {
  return std::pow(10.0, std::floor(std::log10(value)) - 4.0);
}

// Returns a positive number with five digits, not above `value`; 0 for others.
double rounded_down(double value) {
  return value > 0.0 ? std::floor(value / last_digit(value)) * last_digit(value) : 0.0;
}

// Returns a positive number with five digits, not below `value`; 0 for others.
double rounded_up(double value) {
  return value > 0.0 ? std::ceil(value / last_digit(value)) * last_digit(value) : 0.0;
}

// A sticking bristle as the sampled device has to hold it: a spring with a damper.
struct HeldBristle {
  double stiffness_N_per_m = 0.0;
  // The damping under a light touch: the contact's alone.
  double least_damping_Ns_per_m = 0.0;
  // The bristle's damping sigma1, which the normal force multiplies.
  double damping_s_per_m = 0.0;
  // The largest force that sigma1 is multiplied with: normal force times the friction's texture.
  double most_pressure_N = 0.0;

  // The damping under the largest normal force.
  [[nodiscard]] double most_damping_Ns_per_m() const {
    return least_damping_Ns_per_m + damping_s_per_m * most_pressure_N;
  }
};

// Returns the largest factor that a texture of that use applies; 1 without one.
double largest_factor(const DetailDescription& detail, rendering::TextureUse use) {
  const auto texture = std::ranges::find(detail.textures, use, &TextureDescription::use);
  return texture == detail.textures.end() ? 1.0 : std::max(texture->low, texture->high);
}

// A model whose own stiffness is not given sticks by the contact's spring.
HeldBristle held_bristle(const ObjectDescription& object, double max_normal_force_N) {
  const FrictionParameters& friction = object.material.friction;
  const double contact_N_per_m = object.material.stiffness_N_per_m *
                                 largest_factor(object.detail, rendering::TextureUse::stiffness);
  return {.stiffness_N_per_m =
              friction.stiffness_N_per_m > 0.0 ? friction.stiffness_N_per_m : contact_N_per_m,
          .least_damping_Ns_per_m = object.material.damping_Ns_per_m,
          .damping_s_per_m = friction.damping_s_per_m,
          .most_pressure_N =
              max_normal_force_N * largest_factor(object.detail, rendering::TextureUse::friction)};
}

// Returns the largest stiffness that is stable at both ends of the damping, N/m.
double largest_stiffness(const SampledDevice& device, const HeldBristle& bristle) {
  return std::min(largest_stable_stiffness(device, bristle.least_damping_Ns_per_m),
                  largest_stable_stiffness(device, bristle.most_damping_Ns_per_m()));
}

// Returns the largest stable sigma1, s/m; 0 if the stiffness is too large even for a light touch.
double largest_damping(const SampledDevice& device, const HeldBristle& bristle) {
  const double room =
      largest_stable_damping(device, bristle.stiffness_N_per_m) - bristle.least_damping_Ns_per_m;
  const bool light_touch_holds =
      spectral_radius(device, {bristle.stiffness_N_per_m, bristle.least_damping_Ns_per_m}) < 1.0;
  return light_touch_holds && room > 0.0 ? room / bristle.most_pressure_N : 0.0;
}

// Returns what to write in the scene, as numbers that are stable.
std::string remedy(const SampledDevice& device, const HeldBristle& bristle) {
  const double stiffness = rounded_down(largest_stiffness(device, bristle));
  const double damping = rounded_down(largest_damping(device, bristle));
  if (stiffness > 0.0 && damping > 0.0) {
    return fmt::format(
        "write a stiffness_N_per_m of at most {:.6g}, or a damping_s_per_m of at most {:.6g}",
        stiffness, damping);
  }
  if (stiffness > 0.0) {
    return fmt::format("write a stiffness_N_per_m of at most {:.6g}", stiffness);
  }
  if (damping > 0.0) {
    return fmt::format("write a damping_s_per_m of at most {:.6g}", damping);
  }
  // Neither number alone helps. Half of the stiffness that a light touch can hold leaves room for
  // damping.
  HeldBristle softer = bristle;
  softer.stiffness_N_per_m =
      rounded_down(0.5 * largest_stable_stiffness(device, bristle.least_damping_Ns_per_m));
  if (!(softer.stiffness_N_per_m > 0.0)) {
    return "it can hold none at all; give the device damping, or the contact less";
  }
  return fmt::format("write a stiffness_N_per_m of {:.6g} with a damping_s_per_m of at most {:.6g}",
                     softer.stiffness_N_per_m, rounded_down(largest_damping(device, softer)));
}

}  // namespace

void require_stable_friction(const ObjectDescription& object, const SceneDescription& scene) {
  const FrictionParameters& friction = object.material.friction;
  const HeldBristle bristle = held_bristle(object, scene.device.max_normal_force_N);
  const bool is_rendered = friction.stiffness_N_per_m > 0.0 || friction.damping_s_per_m > 0.0;
  const SampledDevice& device = scene.device.device;
  const auto holds = [&](double damping) {
    return spectral_radius(device, {bristle.stiffness_N_per_m, damping}) < 1.0;
  };
  if (!is_rendered || friction.coulomb <= 0.0 ||
      (holds(bristle.least_damping_Ns_per_m) && holds(bristle.most_damping_Ns_per_m()))) {
    return;
  }
  throw InputError(fmt::format(
      "{}:{}: {} friction: bristles of {:.6g} N/m and {:.6g} to {:.6g} N s/m (by the normal force, "
      "up to {} N) buzz on a device of {}; {}; [device] says which device it is",
      scene.file, object.friction_line, object.name, bristle.stiffness_N_per_m,
      bristle.least_damping_Ns_per_m, bristle.most_damping_Ns_per_m(),
      scene.device.max_normal_force_N, in_words(scene.device), remedy(device, bristle)));
}

std::vector<std::string> friction_warnings(const ObjectDescription& object,
                                           const SceneDescription& scene) {
  const rendering::LugrePassivity passivity = lugre_passivity(object.material.friction);
  if (passivity.passive) {
    return {};
  }
  return {fmt::format(
      "{}:{}: {} friction: above {:.3g} m/s the damping of the bristles can give out energy; write "
      "a viscous_s_per_m of at least {:.6g}, or a damping_fade_m_per_s of at most {:.6g}",
      scene.file, object.friction_line, object.name, passivity.safe_speed_m_per_s,
      rounded_up(passivity.needed_viscous_s_per_m), rounded_down(passivity.largest_fade_m_per_s))};
}

}  // namespace tactus::host
