// The ten questions of `tactus init arm`.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "host_tools/init/device_plan.h"

namespace tactus::host {

// A question to the user.
struct PlanQuestion {
  // The option that answers it, without its dashes.
  std::string_view option;
  std::string text;
  // The answer that most give.
  std::string usual;
};

// Reads an answer. Throws InputError with the reason if it is none.
using ReadAnswer = std::function<void(const std::string&)>;
// Asks one question, and passes the answer on.
using AskQuestion = std::function<void(const PlanQuestion&, const ReadAnswer&)>;

// Asks everything and returns the plan. Throws InputError as the answers do.
DevicePlan ask_plan(const AskQuestion& ask);

}  // namespace tactus::host
