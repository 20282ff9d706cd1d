#include "host_tools/faults/fault_table.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "firmware/safety/faults.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::string_view kHeader = "| code | name | meaning | reaction | recovery |";

}  // namespace

std::string fault_table_markdown() {
  std::string text = fmt::format("{}\n|---|---|---|---|---|\n", kHeader);
  for (const firmware::FaultText& fault : firmware::kFaultTexts) {
    fmt::format_to(std::back_inserter(text), "| {} | {} | {} | {} | {} |\n",
                   firmware::fault_code(fault.bit), fault.name, fault.meaning, fault.reaction,
                   fault.recovery);
  }
  return text;
}

std::string with_fault_table(const std::string& document) {
  const std::size_t start = document.find(kHeader);
  if (start == std::string::npos) {
    throw InputError(fmt::format("no table of faults; its header is {}", kHeader));
  }
  // A blank line ends a table in Markdown.
  const std::size_t end = document.find("\n\n", start);
  const std::string after = end == std::string::npos ? "" : document.substr(end + 1);
  return document.substr(0, start) + fault_table_markdown() + after;
}

std::string fault_table_text() {
  std::string text;
  for (const firmware::FaultText& fault : firmware::kFaultTexts) {
    fmt::format_to(std::back_inserter(text), "{:2}  {:25} {}\n{:30}{}; then {}\n",
                   firmware::fault_code(fault.bit), fault.name, fault.meaning, "", fault.reaction,
                   fault.recovery);
  }
  return text;
}

std::string fault_table_json() {
  auto faults = nlohmann::ordered_json::array();
  for (const firmware::FaultText& fault : firmware::kFaultTexts) {
    faults.push_back({{"code", firmware::fault_code(fault.bit)},
                      {"name", fault.name},
                      {"trigger", fault.meaning},
                      {"reaction", fault.reaction},
                      {"recovery", fault.recovery}});
  }
  return faults.dump() + "\n";
}

}  // namespace tactus::host
