#include <pybind11/stl.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "firmware/telemetry/telemetry_event.h"
#include "host_tools/export/chosen_ticks.h"
#include "host_tools/python/bindings.h"
#include "host_tools/recording/record_columns.h"
#include "host_tools/recording/recording.h"

namespace tactus::host::python {

namespace py = pybind11;

namespace {

// Returns the chosen columns of the chosen ticks, by their names.
py::dict read_ticks(const std::string& file, const ExportChoice& choice) {
  std::vector<std::string> names;
  std::vector<ColumnArray> columns;
  {
    const py::gil_scoped_release released;
    Recording recording(file);
    const std::size_t joints = joints_of(recording);
    const std::vector<ChosenColumn> chosen = columns_of(choice, joints);
    columns.resize(chosen.size());
    std::vector<ColumnValue> values;
    visit_chosen_ticks(
        recording, choice, [](double /*time_s*/) { check_signals(); },
        [&](const firmware::RecordedTick& tick) {
          read_columns(tick, joints, values);
          for (std::size_t i = 0; i < chosen.size(); ++i) {
            columns[i].append(values[chosen[i].index]);
          }
        });
    names.reserve(chosen.size());
    for (const ChosenColumn& column : chosen) {
      names.push_back(column.name);
    }
  }
  return dict_of(names, columns);
}

// Returns the information of a run, and its events as tuples of tick, kind, name and value.
py::tuple read_events(const std::string& file) {
  const Recording recording(file);
  py::dict info;
  for (const auto& [key, text] : recording.info()) {
    info[py::str(std::string(key))] = std::string(text);
  }
  py::list events;
  for (const firmware::TelemetryEvent& event : recording.events()) {
    events.append(py::make_tuple(event.tick, std::string(kind_of(event)),
                                 std::string(firmware::name_of(event)), event.value));
  }
  return py::make_tuple(std::move(info), std::move(events));
}

}  // namespace

void bind_recording(py::module_& module) {
  module.def(
      "read_recording",
      [](const std::string& file, std::vector<std::string> fields, std::uint64_t every,
         double from_s, double to_s) {
        return read_ticks(
            file, {.fields = std::move(fields), .every = every, .from_s = from_s, .to_s = to_s});
      },
      py::arg("file"), py::arg("fields"), py::arg("every"), py::arg("from_s"), py::arg("to_s"));
  module.def("read_events", &read_events, py::arg("file"));
}

}  // namespace tactus::host::python
