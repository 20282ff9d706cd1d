#include "host_tools/cli/faults_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <span>
#include <string>

#include "host_tools/faults/fault_table.h"
#include "host_tools/files/atomic_file.h"

namespace tactus::host {
namespace {

constexpr const char* kFaultsExamples =
    "Examples:\n"
    "  tactus faults\n"
    "  tactus faults | grep -A1 overspeed\n"
    "  tactus faults --json | jq '.[] | select(.name == \"overspeed\")'\n"
    "  tactus faults --markdown --into firmware/README.md";

struct FaultsOptions {
  bool markdown = false;
  bool json = false;
  std::string into;
};

void run(const FaultsOptions& options) {
  if (!options.into.empty()) {
    const std::string text = with_fault_table(read_file(options.into));
    write_file_atomically(options.into, std::as_bytes(std::span(text)));
    return;
  }
  fmt::print("{}", options.json       ? fault_table_json()
                   : options.markdown ? fault_table_markdown()
                                      : fault_table_text());
}

}  // namespace

void add_faults_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("faults", "List what stops or limits the controller, and the way back");
  const auto options = std::make_shared<FaultsOptions>();
  CLI::Option* markdown = verb->add_flag("--markdown", options->markdown, "As a Markdown table");
  verb->add_option("--into", options->into, "Replace the table in this file")->needs(markdown);
  verb->add_flag("--json", options->json, "As a JSON array")->excludes(markdown);
  verb->footer(kFaultsExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
