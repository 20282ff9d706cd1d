#include <pybind11/stl.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host_tools/python/bindings.h"
#include "host_tools/python/scene_file.h"
#include "host_tools/recording/record_columns.h"
#include "host_tools/simulation/run.h"
#include "host_tools/simulation/run_recording.h"

namespace tactus::host::python {

namespace py = pybind11;

namespace {

// The ticks of one simulated device: the columns of a recording, and the hand's wish.
class SimulatedColumns {
 public:
  SimulatedColumns(const Simulation& simulation, std::size_t device)
      : device_(device),
        joints_(recorded_tick(simulation, device).joint_count),
        names_(column_names(joints_)) {
    names_.insert(names_.end(), {"wish_x_m", "wish_y_m", "wish_z_m"});
    columns_.resize(names_.size());
  }

  void add(const Simulation& simulation) {
    read_columns(recorded_tick(simulation, device_), joints_, values_);
    const Vec3& wish_W = simulation.wish_W(device_);
    values_.insert(values_.end(), {wish_W.x(), wish_W.y(), wish_W.z()});
    for (std::size_t i = 0; i < values_.size(); ++i) {
      columns_[i].append(values_[i]);
    }
  }

  [[nodiscard]] py::dict arrays() const { return dict_of(names_, columns_); }

 private:
  std::size_t device_;
  std::size_t joints_;
  std::vector<std::string> names_;
  std::vector<ColumnArray> columns_;
  std::vector<ColumnValue> values_;
};

// Returns the columns of each device, and the warnings.
py::tuple simulate_scene(const SceneFile& scene, const RunOptions& options) {
  constexpr std::uint64_t kTicksBetweenSignals = 4096;
  std::vector<SimulatedColumns> devices;
  RunPlan plan;
  {
    const py::gil_scoped_release released;
    plan = plan_run(options, scene.image());
    Simulation simulation(plan.devices, scene.image().objects(), scene.image().tool_radius_m());
    for (std::size_t i = 0; i < simulation.device_count(); ++i) {
      devices.emplace_back(simulation, i);
    }
    run(simulation, plan.seconds, options.rate_hz, [&](const Simulation& now) {
      for (SimulatedColumns& device : devices) {
        device.add(now);
      }
      if (now.record().tick % kTicksBetweenSignals == 0) {
        check_signals();
      }
    });
  }
  py::list arrays;
  for (const SimulatedColumns& device : devices) {
    arrays.append(device.arrays());
  }
  return py::make_tuple(std::move(arrays), plan.warnings);
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<RunOptions>(module, "RunOptions")
      .def(py::init<>())
      .def_readwrite("devices", &RunOptions::devices)
      .def_readwrite("hands", &RunOptions::hands)
      .def_readwrite("seed", &RunOptions::seed)
      .def_readwrite("rate_hz", &RunOptions::rate_hz)
      .def_readwrite("compensated_share", &RunOptions::compensated_share)
      .def_readwrite("seconds", &RunOptions::seconds)
      .def_readwrite("paths", &RunOptions::paths)
      .def_readwrite("faults", &RunOptions::faults);
  module.def("simulate", &simulate_scene, py::arg("scene"), py::arg("options"));
}

}  // namespace tactus::host::python
