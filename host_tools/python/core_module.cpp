// The extension module tactus._core. The package `tactus` around it has the documentation for
// users.
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "host_tools/input_error.h"
#include "host_tools/python/bindings.h"
#include "host_tools/remote/remote.h"

namespace tactus::host::python {

namespace py = pybind11;

void check_signals() {
  const py::gil_scoped_acquire held;
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
}

py::array array_of(std::span<const double> numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

namespace {

py::array array_of_column(const ColumnArray& column) {
  py::array array(py::dtype(column.type()), static_cast<py::ssize_t>(column.size()));
  auto* const bytes = static_cast<std::byte*>(array.mutable_data());
  if (!column.has_words()) {
    const auto values = std::as_bytes(std::span(column.numbers()));
    std::ranges::copy(values, bytes);
    return array;
  }
  for (std::size_t i = 0; i < column.size(); ++i) {
    const std::vector<char32_t> text = column.text(i);
    std::ranges::copy(std::as_bytes(std::span(text)), bytes + i * column.value_bytes());
  }
  return array;
}

}  // namespace

py::dict dict_of(std::span<const std::string> names, std::span<const ColumnArray> columns) {
  py::dict arrays;
  for (std::size_t i = 0; i < names.size(); ++i) {
    arrays[py::str(names[i])] = array_of_column(columns[i]);
  }
  return arrays;
}

}  // namespace tactus::host::python

PYBIND11_MODULE(_core, module) {
  namespace python = tactus::host::python;
  module.doc() =
      "The host tools of Tactus as functions; the package tactus has their documentation.";
  const auto error = pybind11::register_exception<tactus::host::InputError>(module, "Error");
  pybind11::register_exception<tactus::host::UnreachableError>(module, "Unreachable", error);
  module.attr("__version__") = TACTUS_VERSION;
  python::bind_bake(module);
  python::bind_scene(module);
  python::bind_simulation(module);
  python::bind_friction(module);
  python::bind_certify(module);
  python::bind_recording(module);
  python::bind_live(module);
}
