// The file of `tactus touch --body-energy`: the energy of each body, and what hands have given it.
#pragma once

#include <filesystem>
#include <vector>

#include "host_tools/simulation/run_log.h"
#include "host_tools/touch/named_bodies.h"
#include "rendering/geometry/vector.h"
#include "rendering/scene/scene_image.h"
#include "rendering/world/world.h"

namespace tactus::host {

// One row for each tick and body, in the order of the objects: the kinetic and the potential
// energy, the work that the hands have done on the body since the first row, and what the body has
// lost since then, J: the work without the gain of both energies.
class BodyEnergyCsv {
 public:
  // Throws InputError if the file cannot be written, or if the scene has no bodies.
  BodyEnergyCsv(const std::filesystem::path& path, const rendering::SceneImage& scene);

  // Appends the bodies as they are at `t_s`, before the tick of that time. It must see every tick.
  void add(double t_s, const rendering::World& world);
  // Puts the complete file in its place.
  void close() { file_.close(); }

 private:
  struct Account {
    NamedBody body;
    // The energy in the first row, and the work of the hands since then, J.
    double start_J = 0.0;
    double work_J = 0.0;
  };

  LogFile file_;
  Vec3 gravity_W_;
  std::vector<Account> accounts_;
  bool has_begun_ = false;
};

}  // namespace tactus::host
