// The files about bodies that a run leaves, as the user asks for them.
#pragma once

#include <optional>
#include <string>

#include "host_tools/touch/bodies_csv.h"
#include "host_tools/touch/body_energy_csv.h"
#include "rendering/scene/scene_image.h"
#include "rendering/world/world.h"

namespace tactus::host {

// The names of the files; empty for those that are not wanted.
struct BodyFileNames {
  std::string places;
  std::string energy;
};

class BodyFiles {
 public:
  // Throws InputError if a file cannot be written, or if the scene has no bodies.
  BodyFiles(const BodyFileNames& names, const rendering::SceneImage& scene) {
    if (!names.places.empty()) {
      places_.emplace(names.places, scene);
    }
    if (!names.energy.empty()) {
      energy_.emplace(names.energy, scene);
    }
  }

  // Appends the bodies as they are at `t_s`, before the tick of that time.
  void add(double t_s, const rendering::World& world) {
    if (places_) {
      places_->add(t_s, world);
    }
    if (energy_) {
      energy_->add(t_s, world);
    }
  }
  // Puts the complete files in their places.
  void close() {
    if (places_) {
      places_->close();
    }
    if (energy_) {
      energy_->close();
    }
  }

 private:
  std::optional<BodiesCsv> places_;
  std::optional<BodyEnergyCsv> energy_;
};

}  // namespace tactus::host
