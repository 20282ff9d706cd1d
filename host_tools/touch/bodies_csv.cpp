#include "host_tools/touch/bodies_csv.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <iterator>
#include <string_view>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::string_view kBodiesColumns =
    "t_s,body,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,"
    "wz_rad_per_s\n";

Eigen::Quaterniond upper_half(const Mat3& rotation) {
  Eigen::Quaterniond q(rotation);
  q.normalize();
  return q.w() < 0.0 ? Eigen::Quaterniond(-q.coeffs()) : q;
}

// Returns a name as a field of a CSV file.
std::string field(std::string_view name) {
  if (name.find_first_of(",\"\n") == std::string_view::npos) {
    return std::string(name);
  }
  std::string quoted = "\"";
  for (const char letter : name) {
    quoted += letter;
    if (letter == '"') {
      quoted += letter;
    }
  }
  return quoted + '"';
}

}  // namespace

BodiesCsv::BodiesCsv(const std::filesystem::path& path, const rendering::SceneImage& scene)
    : file_(path, kBodiesColumns) {
  for (std::uint32_t i = 0; i < scene.objects().size(); ++i) {
    const rendering::Object& object = scene.objects()[i];
    if (is_body(object)) {
      bodies_.push_back({.name = field(scene.object_name(i)),
                         .object = i,
                         .axes_O = scene.bodies()[object.body].axes_O});
    }
  }
  if (bodies_.empty()) {
    throw InputError(
        "the scene has no bodies; give an object a [object.body] and bake the scene again, or "
        "leave out --bodies");
  }
}

void BodiesCsv::add(double t_s, const rendering::World& world) {
  for (const NamedBody& named : bodies_) {
    const rendering::RigidBody& body = *world.body(named.object);
    const rendering::BodyMotion& motion = body.motion();
    const Vec3& p = motion.center_W;
    const Vec3& v = motion.velocity_W;
    const Vec3& w = body.angular_velocity_W();
    const Eigen::Quaterniond q = upper_half(motion.rotation_WO * named.axes_O);
    fmt::format_to(std::back_inserter(file_.buffer()),
                   "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", t_s, named.name, p.x(), p.y(),
                   p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
  }
  file_.flush_if_full();
}

}  // namespace tactus::host
