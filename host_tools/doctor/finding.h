// The result of one check of the doctor.
#pragma once

#include <string>
#include <vector>

namespace tactus::host {

enum class FindingState {
  well,
  advice,      // works, and would work better
  mend,        // the controller will not run, or not on time
  not_looked,  // the machine did not say
};

struct Finding {
  std::string check;  // "real-time priority"
  FindingState state = FindingState::well;
  std::string found;   // what is there, and what is wrong with it
  std::string remedy;  // the command that mends it; empty where all is well
};

using Findings = std::vector<Finding>;

inline Finding well(std::string check, std::string found) {
  return {std::move(check), FindingState::well, std::move(found), {}};
}

}  // namespace tactus::host
