// Explains the ticks of a controller, for `tactus sim --explain` and `tactus replay --explain`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "firmware/control/controller.h"
#include "firmware/telemetry/explanation.h"
#include "firmware/telemetry/record.h"
#include "host_tools/explain/explainer.h"
#include "host_tools/explain/steps_csv.h"

namespace tactus::host {

// Watches a device of a controller and writes the steps of every tick to a file. The controller
// must not tick without it once it watches.
class RunExplanation {
 public:
  // The tool has this radius, m. The clock measures the steps of the ticks, and the
  // controller's stages; null: a replay, which has the times of its recording. Throws InputError if
  // the file cannot be created.
  RunExplanation(const std::filesystem::path& file, firmware::Controller& controller,
                 double tool_radius_m, firmware::NowNs now_ns, std::size_t device = 0);
  ~RunExplanation() = default;
  RunExplanation(const RunExplanation&) = delete;
  RunExplanation& operator=(const RunExplanation&) = delete;

  // Writes the tick that has ended, whose record this is, and begins the next one. `recorded_ns`
  // are the times of its steps if no clock measures them. Returns the tick's summary.
  firmware::Explanation add(const firmware::TelemetryRecord& record,
                            const std::optional<firmware::StepTimes>& recorded_ns = {});
  // Writes the rest and puts the file in its place.
  void close() { steps_.close(); }

 private:
  Explainer explainer_;
  StepsCsv steps_;
};

}  // namespace tactus::host
