#include "host_tools/cli/foxglove_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "host_tools/cli/reach_controller.h"
#include "host_tools/cli/run_folder_option.h"
#include "host_tools/foxglove/foxglove_session.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kFoxgloveExamples =
    "Serves the scene as a mesh, tool, proxy, force, joints, state and timing to up to 8 clients, "
    "and takes no commands.\n"
    "In Foxglove: Open connection, Foxglove WebSocket, ws://localhost:8765, then a 3D panel. "
    "PlotJuggler has it\n"
    "among its streaming sources. Numbers have the names of tactus watch --list.\n"
    "\n"
    "Examples:\n"
    "  tactus sim bunny.tactus --path wish.csv --serve & tactus foxglove\n"
    "  tactus foxglove --device left              one device of several; without it all of them\n"
    "  tactus foxglove --rate-hz 200 --port 9000  more messages a second, another port\n"
    "  tactus foxglove --serial /dev/ttyACM0      a bare board at the other end of a line\n"
    "  ssh -L 8765:localhost:8765 board tactus foxglove    that of another machine, by a tunnel";

// The verb's options as the user gave them.
struct FoxgloveVerbOptions {
  RunFolderOption run;
  FoxgloveOptions serve;
  // True if one device was named.
  bool is_one_device = false;
};

void warn_of_network(const std::string& address) {
  if (!address.starts_with("127.")) {
    fmt::print(
        stderr,
        "tactus foxglove: warning: --address {} lets every program that reaches this machine "
        "see the run; nothing is encrypted and nobody is asked for a password\n",
        address);
  }
}

void run_foxglove(const FoxgloveVerbOptions& options) {
  const bool is_line = !options.run.serial.empty();
  warn_of_network(options.serve.server.address);
  with_controller(options.run, {.ticks = true, .images = true},
                  [&](const std::filesystem::path& folder, const LineSession* line) {
                    FoxgloveOptions serve = options.serve;
                    serve.first_folder =
                        is_line ? folder : std::filesystem::path(options.run.run_dir);
                    if (options.is_one_device) {
                      serve.only_folder = folder;
                    }
                    serve_foxglove(serve, [line] { return line != nullptr && line->has_failed(); });
                  });
}

}  // namespace

void add_foxglove_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("foxglove", "Show a running controller in Foxglove or PlotJuggler");
  const auto options = std::make_shared<FoxgloveVerbOptions>();
  add_run_folder_option(*verb, options->run);
  FoxgloveServerOptions& server = options->serve.server;
  verb->add_option("--address", server.address,
                   "IPv4 address of this machine on which to serve; 0.0.0.0: all of its networks")
      ->check(CLI::ValidIPV4)
      ->capture_default_str();
  verb->add_option("--port", server.port, "Port; 0: one that is free, which is then printed")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  verb->add_option("--rate-hz", options->serve.rate_Hz, "Messages of each topic a second")
      ->check(CLI::Range(kLeastFoxgloveRate_Hz, kMostFoxgloveRate_Hz))
      ->capture_default_str();
  verb->footer(kFoxgloveExamples);
  verb->callback([verb, options] {
    options->is_one_device = verb->count("--device") > 0;
    run_foxglove(*options);
  });
}

}  // namespace tactus::host
