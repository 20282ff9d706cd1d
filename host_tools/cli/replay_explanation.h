// Explains the ticks of a replay, and compares them with the explanations that the recording has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host_tools/explain/run_explanation.h"
#include "host_tools/recording/recording.h"

namespace tactus::host {

class ReplayExplanation {
 public:
  // The controller repeats the ticks of the recording. Throws InputError if the file cannot be
  // created.
  ReplayExplanation(const std::string& file, firmware::Controller& controller, double tool_radius_m,
                    Recording& recording);

  // Writes the tick that has been repeated, with the recorded times of its steps.
  void add(const firmware::TelemetryRecord& record);
  // Completes the file and prints how the recorded explanations compare.
  void close();

  // Returns true if no recorded explanation differs.
  [[nodiscard]] bool agrees() const { return difference_.empty(); }

 private:
  RunExplanation steps_;
  Recording& recording_;
  // The recorded explanation of this tick or of a later one.
  std::optional<firmware::Explanation> next_;
  bool at_end_ = false;
  std::uint64_t compared_ = 0;
  // The first difference in words.
  std::string difference_;
};

}  // namespace tactus::host
