// Saves and restores the state of a world: the places of its objects, then the state of each tool.
#include "rendering/objects/scene_objects.h"
#include "rendering/state/plain_states.h"
#include "rendering/surface/deformable_mesh.h"
#include "rendering/world/effect_touch.h"
#include "rendering/world/tool_touch.h"
#include "rendering/world/world.h"

namespace tactus::rendering {

// The boxes are saved and not refitted: they lag the vertices by a part of a pass.
void DeformableMesh::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [before, now, wanted, nodes, triangles, nodes_left, motion_per_pass_m,
                          moved_in_pass_m, moved_in_last_pass_m, step_m, asked] = *this;
  archive.same(now.size());
  archive.same(nodes.size());
  archive.up_to(nodes_left, nodes.size());
  archive(moved_in_pass_m, moved_in_last_pass_m, step_m, asked);
  archive.vertices(before);
  archive.vertices(now);
  archive.vertices(wanted);
  for (BvhNode& node : nodes) {
    archive.vertices({&node.lower, 1});
    archive.vertices({&node.upper, 1});
  }
}

void SceneObjects::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [objects, tick_s, movers, changed, still, independent, independent_count] =
      *this;
  archive.same(objects.size());
  archive.same(movers.all().size());
  archive.same(movers.deformable_count());
  movers.transfer_moved(archive);
  archive(tick_s, movers);
  transfer_changed(archive);
  archive.same(independent_count);
}

// Saves the methods and materials that set_method and set_material have changed.
void SceneObjects::transfer_changed(StateArchive& archive) {
  std::size_t count = changed_.count();
  archive.up_to(count, kMaxChangedObjects);
  if (archive.is_reading()) {
    changed_.clear();
  }
  std::uint32_t number = 0;
  for (std::size_t k = 0; k < count && archive.good(); ++k, ++number) {
    while (!archive.is_reading() && !changed_.has(number)) {
      ++number;
    }
    archive(number);
    archive.require(number < objects_.size());
    if (!archive.good()) {
      break;
    }
    ContactMethod method = (*this)[number].method;
    Material now = material(number);
    archive.choice(method, kLastContactMethod);
    archive(now.stiffness_N_per_m, now.damping_Ns_per_m, now.friction);
    archive.require(sound(now) && (method == objects_[number].method ||
                                   can_render(method, objects_[number], now)));
    if (!archive.is_reading() || !archive.good()) {
      continue;
    }
    if (Object* const changed = changed_.change(number, objects_[number]); changed != nullptr) {
      changed->method = method;
      changed->material = now;
    }
  }
  if (archive.is_reading()) {
    archive.require(count_independent() <= kMaxIndependentObjects);
    if (!archive.good()) {
      changed_.clear();
    }
    group();
  }
}

void Movers::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [objects, mover_of, movers, orders, count, anything_moved, pool, wave_pool,
                          deformables, deformable_count] = *this;
  for (std::size_t k = 0; k < count; ++k) {
    transfer_one(archive, k);
  }
  for (std::size_t k = 0; k < deformable_count; ++k) {
    archive(deformables[k]);
  }
}

// An object that the outside has taken over has no motion of its own any more; a state that gives
// it one again is refused unless the scene has it.
void Movers::transfer_one(StateArchive& archive, std::size_t k) {
  [[maybe_unused]] auto& [object, X_WO_before, X_WO, twist, deformable, primitive_W, bounds_O,
                          motion, wave, next_vertex, moved, middle_W, middle_before_W, radius_m,
                          shift_m, turn] = movers_[k];
  auto& [ordered_X_WO, ordered_twist] = orders_[k];
  archive(X_WO_before, X_WO, twist, primitive_W.X_WO, bounds_O, moved, ordered_X_WO, ordered_twist);
  const std::size_t vertices = objects_[object].mesh.vertices.size();
  archive.up_to(next_vertex, static_cast<std::uint32_t>(vertices));
  archive.require(next_vertex == 0 || next_vertex < vertices);
  bool moves_by_itself = motion != nullptr;
  archive(moves_by_itself);
  archive.require(!moves_by_itself || objects_[object].motion != nullptr);
  if (archive.is_reading()) {
    motion = moves_by_itself && archive.good() ? objects_[object].motion : nullptr;
    if (objects_[object].deforms) {
      movers_[k].set_bounds(bounds_O);
    }
    movers_[k].place_ball();
  }
}

void ToolTouch::transfer(StateArchive& archive, const SceneObjects& scene) {
  [[maybe_unused]] auto& [radius_m, proxy, independent, needle, last_proxy_W, spent, placed] =
      *this;
  proxy.transfer(archive, scene);
  independent.transfer(archive, scene);
  needle.transfer(archive);
  archive(last_proxy_W, placed);
}

void EffectTouch::transfer(StateArchive& archive, std::size_t effects) {
  auto& [states] = *this;
  for (std::size_t i = 0; i < effects; ++i) {
    archive(states[i]);
  }
}

// Tools and effects must be as many as in the saved world; the rest follows in the order of a tick.
void World::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [scene, bodies, first_tool, more_tools, effects, tick_s, time_s,
                          tool_count, budget, standing_units] = *this;
  archive.same(tool_count);
  archive.same(effects.size());
  archive(time_s, scene, bodies);
  for (std::size_t i = 0; i < tool_count; ++i) {
    auto& [contacts, memories] = slot(i);
    contacts.transfer(archive, scene);
    memories.transfer(archive, effects.size());
  }
}

}  // namespace tactus::rendering
