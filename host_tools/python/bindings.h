// The parts of the extension module tactus._core. Each function adds the names of one part of the
// host tools to the module; tactus/_core.pyi lists them with their types.
//
// Exceptions of the host tools become Python's at this border. A call that computes or waits lets
// other threads of Python run meanwhile.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "host_tools/export/column_array.h"

namespace tactus::host::python {

// A one-dimensional or larger array of numbers in C order; pybind11 copies what is laid out
// otherwise.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

void bind_bake(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_friction(pybind11::module_& module);
void bind_certify(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_live(pybind11::module_& module);

// Lets Ctrl-C end a long call, which has released Python's lock. Throws Python's exception.
void check_signals();

// Returns a copy of the numbers as a one-dimensional array.
pybind11::array array_of(std::span<const double> numbers);

// Returns the columns as arrays, by their names in their order.
pybind11::dict dict_of(std::span<const std::string> names, std::span<const ColumnArray> columns);

}  // namespace tactus::host::python
