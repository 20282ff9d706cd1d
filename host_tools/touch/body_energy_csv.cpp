#include "host_tools/touch/body_energy_csv.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <utility>

#include "rendering/bodies/body_energy.h"

namespace tactus::host {
namespace {

constexpr std::string_view kBodyEnergyColumns =
    "t_s,body,kinetic_J,potential_J,work_by_hands_J,lost_J\n";

}  // namespace

BodyEnergyCsv::BodyEnergyCsv(const std::filesystem::path& path, const rendering::SceneImage& scene)
    : file_(path, kBodyEnergyColumns), gravity_W_(scene.gravity_W()) {
  for (NamedBody& body : named_bodies(scene, "--body-energy")) {
    accounts_.push_back({.body = std::move(body)});
  }
}

void BodyEnergyCsv::add(double t_s, const rendering::World& world) {
  for (Account& account : accounts_) {
    const rendering::RigidBody& body = *world.body(account.body.object);
    const double kinetic_J = body.kinetic_energy_J();
    const double potential_J = potential_energy_J(body, gravity_W_);
    if (has_begun_) {
      account.work_J += world.work_by_hands_J(account.body.object);
    } else {
      account.start_J = kinetic_J + potential_J;
    }
    fmt::format_to(std::back_inserter(file_.buffer()), "{},{},{},{},{},{}\n", t_s,
                   account.body.name, kinetic_J, potential_J, account.work_J,
                   account.work_J - (kinetic_J + potential_J - account.start_J));
  }
  has_begun_ = true;
  file_.flush_if_full();
}

}  // namespace tactus::host
