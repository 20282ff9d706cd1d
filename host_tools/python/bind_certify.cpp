#include <string>

#include "host_tools/certify/certify_run.h"
#include "host_tools/python/bindings.h"

namespace tactus::host::python {

namespace py = pybind11;

void bind_certify(py::module_& module) {
  module.def(
      "certify",
      [](const std::string& device, double margin, std::size_t dampings, unsigned threads) {
        const py::gil_scoped_release released;
        return certification_json(
            certify_file(device, {.margin = margin, .dampings = dampings, .threads = threads}));
      },
      py::arg("device"), py::arg("margin"), py::arg("dampings"), py::arg("threads"));
}

}  // namespace tactus::host::python
