// Saves and restores a needle: its layers with their channels, the springs and the account.
#include <algorithm>

#include "rendering/limits.h"
#include "rendering/needle/needle_touch.h"
#include "rendering/state/plain_states.h"

namespace tactus::rendering {
namespace {

// Returns true for a number that stays finite in squares; no scene makes a larger one.
bool is_small(double value) {
  return value >= -1e6 && value <= 1e6;
}

void transfer_channel(StateArchive& archive, NeedleChannel& channel) {
  auto& [entry_O, direction_O, front_m, exists] = channel;
  archive(entry_O, direction_O, front_m, exists);
  archive.require(is_small(entry_O.cwiseAbs().maxCoeff()) && is_small(front_m) &&
                  direction_O.squaredNorm() <= 1.0 + 1e-6);
}

void transfer_shaft(StateArchive& archive, ShaftBristle& shaft) {
  auto& [force_N, slips_in, slips_out] = shaft;
  archive(force_N, slips_in, slips_out);
  archive.require(is_small(force_N));
}

void transfer_pose(StateArchive& archive, NeedlePose& pose) {
  auto& [tip_O, axis_O] = pose;
  archive(tip_O, axis_O);
}

void transfer_account(StateArchive& archive, NeedleEnergy& energy) {
  auto& [fracture_J, crack_m2, friction_J, freed_J] = energy;
  archive(fracture_J, crack_m2, friction_J, freed_J);
}

void transfer_layer(StateArchive& archive, NeedleLayer& layer) {
  auto& [phase, is_left_out, is_inside, is_left, exit_m, depth_m, length_m, channel, shaft,
         sideways_O, last] = layer;
  archive.choice(phase, LayerPhase::pierced);
  archive(is_left_out, is_inside, is_left, exit_m, depth_m, length_m);
  transfer_channel(archive, channel);
  transfer_shaft(archive, shaft);
  archive(sideways_O);
  transfer_pose(archive, last);
  archive.require(is_small(exit_m) && is_small(depth_m) && length_m >= 0.0 && is_small(length_m) &&
                  is_small(sideways_O.cwiseAbs().maxCoeff()));
}

}  // namespace

// The crossings are those of one tick.
void NeedleTouch::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [scene, objects, tissues, count, layers, crossings, tip, energy,
                          is_placed] = *this;
  archive.same(count);
  if (count == 0) {
    return;
  }
  archive(is_placed, tip.force_N);
  archive.require(tip.force_N >= 0.0 && is_small(tip.force_N));
  transfer_account(archive, energy);
  for (NeedleLayer& layer : std::span(layers).first(count)) {
    transfer_layer(archive, layer);
  }
}

}  // namespace tactus::rendering
