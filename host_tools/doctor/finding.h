// The result of one check of the doctor.
#pragma once

#include <string>
#include <vector>

namespace tactus::host {

enum class FindingState {
  // Nothing to do.
  well,
  // Works, and would be steadier with the remedy.
  advice,
  // The controller will not start, will not reach its device or will not be on time.
  mend,
  // The machine did not tell, for example because /proc is not mounted.
  not_looked,
};

// One line of the report.
struct Finding {
  // The name of the thing that was looked at, such as "real-time priority" or "CAN can0".
  std::string check;
  FindingState state = FindingState::well;
  // The state that was found, and its fault if there is one.
  std::string found;
  // A command that mends it, or that shows more; empty where all is well.
  std::string remedy;
};

using Findings = std::vector<Finding>;

// Returns the finding of a check that found nothing to do.
inline Finding well(std::string check, std::string found) {
  return {std::move(check), FindingState::well, std::move(found), {}};
}

}  // namespace tactus::host
