#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "host_tools/bake/bake_json.h"
#include "host_tools/python/bindings.h"

namespace tactus::host::python {

namespace py = pybind11;

namespace {

// The report as JSON, and the warnings.
using BakeFindings = std::pair<std::string, std::vector<std::string>>;

BakeFindings bake_any(const std::string& file, const std::string& image) {
  const py::gil_scoped_release released;
  if (describes_device(file)) {
    const LoadedDevice device = bake_device_file(file, image);
    return {bake_json(device, image), device.warnings()};
  }
  const BakeReport report = bake_file(file, image);
  std::vector<std::string> warnings;
  for (const ObjectReport& object : report.objects) {
    warnings.insert(warnings.end(), object.warnings.begin(), object.warnings.end());
  }
  return {bake_json(report), std::move(warnings)};
}

}  // namespace

void bind_bake(py::module_& module) {
  module.def("bake", &bake_any, py::arg("file"), py::arg("image"));
}

}  // namespace tactus::host::python
