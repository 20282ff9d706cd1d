#include "firmware/safety/faults.h"
#include "host_tools/monitor/screen.h"

namespace tactus::host {

namespace {

// Returns the remedy in full: "reset" in the table stands for several steps.
std::string remedy_of(const firmware::FaultText& text) {
  return text.recovery == "reset" ? "remove the cause, then reset, home, enable"
                                  : std::string(text.recovery);
}

}  // namespace

FaultWords fault_words(std::uint64_t faults, std::uint64_t limits) {
  FaultWords words;
  for (const firmware::FaultText& text : firmware::kFaultTexts) {
    if ((faults & text.bit & firmware::kFaultMask) != 0) {
      words.faults.push_back(std::string(text.name) + ": " + std::string(text.meaning));
      words.remedies.push_back(remedy_of(text));
    }
    if ((limits & text.bit & firmware::kLimitMask) != 0) {
      words.limits += (words.limits.empty() ? "" : ", ") + std::string(text.name);
    }
  }
  return words;
}

}  // namespace tactus::host
