#include "firmware/safety/faults.h"
#include "host_tools/monitor/screen.h"

namespace tactus::host {

FaultWords fault_words(std::uint64_t faults, std::uint64_t limits) {
  FaultWords words;
  for (const firmware::FaultText& text : firmware::kFaultTexts) {
    if ((faults & text.bit & firmware::kFaultMask) != 0) {
      words.faults.push_back(std::string(text.name) + ": " + std::string(text.meaning));
      words.remedies.emplace_back(text.recovery);
    }
    if ((limits & text.bit & firmware::kLimitMask) != 0) {
      words.limits += (words.limits.empty() ? "" : ", ") + std::string(text.name);
    }
  }
  return words;
}

}  // namespace tactus::host
