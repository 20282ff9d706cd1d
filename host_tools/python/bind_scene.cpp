#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_tools/input_error.h"
#include "host_tools/python/bindings.h"
#include "host_tools/python/scene_file.h"
#include "host_tools/touch/follow_paths.h"
#include "host_tools/touch/tool_path.h"
#include "host_tools/touch/touch_hash.h"
#include "rendering/objects/contact_method.h"

namespace tactus::host::python {

namespace py = pybind11;

namespace {

SceneFile scene_of_bytes(const py::bytes& bytes) {
  const std::string_view text = bytes;
  const auto view = std::as_bytes(std::span(text));
  return SceneFile(std::vector<std::byte>(view.begin(), view.end()));
}

py::list objects_of(const SceneFile& scene) {
  py::list objects;
  const rendering::SceneImage& image = scene.image();
  for (std::size_t i = 0; i < image.objects().size(); ++i) {
    const rendering::Object& object = image.objects()[i];
    py::dict entry;
    entry["name"] = std::string(image.object_name(i));
    entry["triangles"] = object.mesh.triangles.size();
    entry["vertices"] = object.mesh.vertices.size();
    entry["contact"] =
        std::string(rendering::kContactMethods.at(static_cast<std::size_t>(object.method)).name);
    entry["stiffness_N_per_m"] = object.material.stiffness_N_per_m;
    entry["damping_Ns_per_m"] = object.material.damping_Ns_per_m;
    entry["moves"] = object.moves;
    objects.append(std::move(entry));
  }
  return objects;
}

// Returns the corners of an object's picture, m, and three of their numbers for each triangle.
py::tuple mesh_of(const SceneFile& scene, std::size_t index) {
  const rendering::MeshView mesh = scene.image().objects()[index].mesh;
  py::array_t<double> vertices({static_cast<py::ssize_t>(mesh.vertices.size()), py::ssize_t{3}});
  py::array_t<std::uint32_t> triangles(
      {static_cast<py::ssize_t>(mesh.triangles.size()), py::ssize_t{3}});
  auto corners = vertices.mutable_unchecked<2>();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 corner = rendering::to_vec3(mesh.vertices[i]);
    for (py::ssize_t axis = 0; axis < 3; ++axis) {
      corners(static_cast<py::ssize_t>(i), axis) = corner[axis];
    }
  }
  auto numbers = triangles.mutable_unchecked<2>();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      numbers(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) = mesh.triangles[i][k];
    }
  }
  return py::make_tuple(std::move(vertices), std::move(triangles));
}

// The course of one tool, in the memory of numpy's arrays.
struct TouchRows {
  explicit TouchRows(std::size_t count)
      : proxy_W(3 * count),
        force_W(3 * count),
        normal_W(3 * count),
        depth_m(count),
        short_of_goal_m(count),
        contact(count),
        friction(count),
        object(count),
        flags(count),
        hash(count) {}

  std::vector<double> proxy_W;
  std::vector<double> force_W;
  std::vector<double> normal_W;
  std::vector<double> depth_m;
  std::vector<double> short_of_goal_m;
  std::vector<std::uint8_t> contact;
  std::vector<std::uint8_t> friction;
  std::vector<std::int64_t> object;
  std::vector<std::uint32_t> flags;
  std::vector<std::uint64_t> hash;
  TouchHash chain;

  void add(const FollowedTick& now, std::size_t tool) {
    const rendering::Touch& touch = now.touches[tool];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto index = static_cast<Eigen::Index>(axis);
      proxy_W[3 * now.tick + axis] = touch.proxy_W[index];
      force_W[3 * now.tick + axis] = touch.force_W[index];
      normal_W[3 * now.tick + axis] = touch.normal_W[index];
    }
    const bool touches = touch.contact != rendering::ContactKind::none;
    depth_m[now.tick] = touch.depth_m;
    short_of_goal_m[now.tick] = touch.short_of_goal_m;
    contact[now.tick] = static_cast<std::uint8_t>(touch.contact);
    friction[now.tick] = static_cast<std::uint8_t>(touch.friction);
    object[now.tick] = touches ? static_cast<std::int64_t>(touch.object) : -1;
    flags[now.tick] = touch.flags;
    hash[now.tick] = chain.add(now.tick, now.t_s, now.tools[tool], touch).state_hash;
  }
};

template <class Value>
py::array rows_of(const std::vector<Value>& values) {
  return py::array_t<Value>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array vectors_of(const std::vector<double>& values) {
  return py::array_t<double>({static_cast<py::ssize_t>(values.size() / 3), py::ssize_t{3}},
                             values.data());
}

py::dict dict_of_rows(const TouchRows& rows) {
  py::dict arrays;
  arrays["proxy_m"] = vectors_of(rows.proxy_W);
  arrays["force_N"] = vectors_of(rows.force_W);
  arrays["normal"] = vectors_of(rows.normal_W);
  arrays["depth_m"] = rows_of(rows.depth_m);
  arrays["contact"] = rows_of(rows.contact);
  arrays["friction_state"] = rows_of(rows.friction);
  arrays["object"] = rows_of(rows.object);
  arrays["flags"] = rows_of(rows.flags);
  arrays["short_of_goal_m"] = rows_of(rows.short_of_goal_m);
  arrays["state_hash"] = rows_of(rows.hash);
  return arrays;
}

std::vector<ToolPath> paths_of(const Numbers& t_s, const Numbers& positions_m) {
  const auto times = t_s.unchecked<1>();
  const auto positions = positions_m.unchecked<3>();
  if (positions.shape(1) != times.shape(0) || positions.shape(2) != 3 || times.shape(0) == 0) {
    throw py::value_error("positions_m has to have the shape (tools, times, 3)");
  }
  const std::vector<double> all_times(times.data(0), times.data(0) + times.shape(0));
  std::vector<ToolPath> paths;
  for (py::ssize_t tool = 0; tool < positions.shape(0); ++tool) {
    std::vector<Vec3> places;
    places.reserve(all_times.size());
    for (py::ssize_t tick = 0; tick < positions.shape(1); ++tick) {
      places.emplace_back(positions(tool, tick, 0), positions(tool, tick, 1),
                          positions(tool, tick, 2));
    }
    paths.emplace_back(fmt::format("positions_m[{}]", tool), all_times, std::move(places));
  }
  return paths;
}

py::list touch_scene(const SceneFile& scene, const Numbers& t_s, const Numbers& positions_m) {
  constexpr std::size_t kTicksBetweenSignals = 4096;
  std::vector<ToolPath> own_paths = paths_of(t_s, positions_m);
  std::vector<TouchRows> rows;
  {
    const py::gil_scoped_release released;
    const ToolPaths paths(std::move(own_paths));
    rows.assign(paths.tools(), TouchRows(paths.size()));
    const auto world = world_of_tools(scene.image(), paths.tools(), scene.name());
    follow_paths(*world, paths,
                 {.before = {}, .watcher = {}, .after = [&](const FollowedTick& now) {
                    for (std::size_t i = 0; i < rows.size(); ++i) {
                      rows[i].add(now, i);
                    }
                    if (now.tick % kTicksBetweenSignals == 0) {
                      check_signals();
                    }
                  }});
  }
  py::list tools;
  for (const TouchRows& each : rows) {
    tools.append(dict_of_rows(each));
  }
  return tools;
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<SceneFile>(module, "SceneFile")
      .def(py::init<const std::string&>(), py::arg("path"),
           py::call_guard<py::gil_scoped_release>())
      .def_static("of_bytes", &scene_of_bytes, py::arg("image"))
      .def_property_readonly("name", &SceneFile::name)
      .def_property_readonly("checksum",
                             [](const SceneFile& scene) { return scene.image().checksum(); })
      .def_property_readonly("tool_radius_m",
                             [](const SceneFile& scene) { return scene.image().tool_radius_m(); })
      .def("objects", &objects_of)
      .def("mesh", &mesh_of, py::arg("index"))
      .def("touch", &touch_scene, py::arg("t_s"), py::arg("positions_m"));
}

}  // namespace tactus::host::python
