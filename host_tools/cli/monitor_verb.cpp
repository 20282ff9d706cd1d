#include "host_tools/cli/monitor_verb.h"

#include "host_tools/cli/reach_controller.h"
#include "host_tools/cli/run_folder_option.h"
#include "host_tools/monitor/session.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace tactus::host {
namespace {

constexpr const char* kMonitorExamples =
    "Shows mode, faults and what to do about them, axes, forces, how the loop keeps its time, and "
    "where energy goes;\n"
    "needs 80 columns and 24 rows, and nothing else that ssh does not have.\n"
    "Keys: h home, e enable, d disable, r reset, x explains the ticks, SPACE estop, q quit.\n"
    "\n"
    "Examples:\n"
    "  tactus monitor                     the controller of this machine\n"
    "  ssh -t board tactus monitor        that of another\n"
    "  tactus monitor --device 2          the second of its devices\n"
    "  tactus monitor --device left       the one of left.tactus\n"
    "  tactus monitor --run-dir /tmp/run  one that was started with that --run-dir\n"
    "  tactus monitor --serial /dev/ttyACM0    a bare board at the other end of a line";

}  // namespace

void add_monitor_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("monitor", "Watch and operate a running controller");
  const auto run = std::make_shared<RunFolderOption>();
  add_run_folder_option(*verb, *run);
  verb->footer(kMonitorExamples);
  verb->callback([run] {
    with_controller(*run, {.ticks = true},
                    [](const std::filesystem::path& folder, const LineSession* line) {
                      run_monitor(folder, [line] { return line != nullptr && line->has_failed(); });
                    });
  });
}

}  // namespace tactus::host
