#include <fmt/format.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host_tools/friction/experiments.h"
#include "host_tools/friction/friction_run.h"
#include "host_tools/friction/parameter_names.h"
#include "host_tools/input_error.h"
#include "host_tools/python/bindings.h"

namespace tactus::host::python {

namespace py = pybind11;

namespace {

// A friction model with its parameters, and the force that presses on the surface.
class FrictionModel {
 public:
  FrictionModel(const std::string& model, const std::vector<std::string>& assignments,
                std::optional<double> normal_force_N)
      : friction_(changed_parameters(model, assignments,
                                     normal_force_N ? ForceScale::per_newton : ForceScale::newton)),
        normal_force_N_(normal_force_N.value_or(1.0)) {}

  [[nodiscard]] py::dict parameters() const;
  [[nodiscard]] py::dict motion(const Numbers& t_s, const Numbers& x_m) const;
  [[nodiscard]] py::dict push(const Numbers& t_s, const Numbers& force_N, double mass_kg,
                              double rate_hz) const;
  [[nodiscard]] py::tuple experiment(const std::string& name,
                                     const std::vector<std::string>& assignments, double mass_kg,
                                     double rate_hz) const;

 private:
  rendering::FrictionParameters friction_;
  double normal_force_N_;
};

// Returns the rate. Throws InputError if it is not one of the program's.
double checked_rate(double rate_hz) {
  const bool is_known = rate_hz >= kLeastFrictionRate_hz && rate_hz <= kMostFrictionRate_hz;
  if (!is_known) {
    throw InputError(fmt::format("rate_hz is {}; it has to be from {} to {}", rate_hz,
                                 kLeastFrictionRate_hz, kMostFrictionRate_hz));
  }
  return rate_hz;
}

TimeSeries series_of(const Numbers& t_s, const Numbers& values) {
  const auto t = t_s.unchecked<1>();
  const auto v = values.unchecked<1>();
  if (t.shape(0) != v.shape(0) || t.shape(0) < 2) {
    throw py::value_error("a course in time has two or more times, and as many values");
  }
  return {.t_s = {t.data(0), t.data(0) + t.shape(0)}, .value = {v.data(0), v.data(0) + v.shape(0)}};
}

py::dict dict_of_track(const FrictionTrack& track) {
  const auto column = [&](auto member) {
    std::vector<double> values;
    values.reserve(track.samples.size());
    for (const FrictionSample& sample : track.samples) {
      values.push_back(sample.*member);
    }
    return array_of(values);
  };
  py::dict columns;
  columns["t_s"] = column(&FrictionSample::t_s);
  columns["x_m"] = column(&FrictionSample::x_m);
  columns["v_m_per_s"] = column(&FrictionSample::v_m_per_s);
  columns["force_N"] = column(&FrictionSample::force_N);
  columns["bristle_m"] = column(&FrictionSample::bristle_m);
  for (const NamedColumn& more : track.more) {
    columns[py::str(more.name)] = array_of(more.values);
  }
  return columns;
}

py::dict dict_of_findings(const FindingsTable& findings) {
  py::dict columns;
  for (std::size_t i = 0; i < findings.columns.size(); ++i) {
    std::vector<double> values;
    values.reserve(findings.rows.size());
    for (const std::vector<double>& row : findings.rows) {
      values.push_back(row[i]);
    }
    columns[py::str(findings.columns[i])] = array_of(values);
  }
  return columns;
}

py::dict FrictionModel::parameters() const {
  py::dict values;
  for (const FrictionParameterName& name : parameters_of(friction_.kind)) {
    values[py::str(std::string(name.symbol))] = friction_.*name.member;
  }
  return values;
}

py::dict FrictionModel::motion(const Numbers& t_s, const Numbers& x_m) const {
  const TimeSeries series = series_of(t_s, x_m);
  FrictionTrack track;
  {
    const py::gil_scoped_release released;
    track = run_motion({.friction = friction_, .normal_force_N = normal_force_N_}, series);
  }
  return dict_of_track(track);
}

py::dict FrictionModel::push(const Numbers& t_s, const Numbers& force_N, double mass_kg,
                             double rate_hz) const {
  const TimeSeries series = series_of(t_s, force_N);
  FrictionTrack track;
  {
    const py::gil_scoped_release released;
    track = run_push({.friction = friction_,
                      .normal_force_N = normal_force_N_,
                      .mass_kg = mass_kg,
                      .rate_hz = checked_rate(rate_hz)},
                     series);
  }
  return dict_of_track(track);
}

py::tuple FrictionModel::experiment(const std::string& name,
                                    const std::vector<std::string>& assignments, double mass_kg,
                                    double rate_hz) const {
  ExperimentResult result;
  {
    const py::gil_scoped_release released;
    const Experiment& known = host::experiment(name);
    ExperimentRun run{.friction = friction_,
                      .normal_force_N = normal_force_N_,
                      .mass_kg = mass_kg,
                      .rate_hz = checked_rate(rate_hz),
                      .setup = known.setup()};
    for (const std::string& assignment : assignments) {
      run.setup.set(assignment);
    }
    result = known.run(run);
  }
  return py::make_tuple(dict_of_track(result.track), dict_of_findings(result.findings));
}

}  // namespace

void bind_friction(py::module_& module) {
  py::class_<FrictionModel>(module, "FrictionModel")
      .def(py::init<const std::string&, const std::vector<std::string>&, std::optional<double>>(),
           py::arg("model"), py::arg("assignments"), py::arg("normal_force_N"))
      .def("parameters", &FrictionModel::parameters)
      .def("motion", &FrictionModel::motion, py::arg("t_s"), py::arg("x_m"))
      .def("push", &FrictionModel::push, py::arg("t_s"), py::arg("force_N"), py::arg("mass_kg"),
           py::arg("rate_hz"))
      .def("experiment", &FrictionModel::experiment, py::arg("name"), py::arg("assignments"),
           py::arg("mass_kg"), py::arg("rate_hz"));
}

}  // namespace tactus::host::python
