#include "host_tools/cli/remote_verbs.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "host_tools/cli/line_verb.h"
#include "host_tools/cli/reach_controller.h"
#include "host_tools/cli/run_folder_option.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"

namespace tactus::host {
namespace {

constexpr const char* kExitCodes =
    "\nExit codes: 0 done, 1 refused (the reply says why and what to do), 2 no controller could be "
    "reached.\nThe replies are described in firmware/linux/commands/README.md.";

// The options of all these verbs; each uses some of them.
struct RemoteOptions {
  RunFolderOption run;
  std::string name;
  std::string value;
  std::string file;
  std::uint32_t ticks = 1;
  bool wait = false;
  double seconds = 0.0;
  bool may_overwrite = false;
  bool json = false;
};
using SharedOptions = std::shared_ptr<RemoteOptions>;

// The texts of a verb for its help.
struct VerbText {
  const char* name;
  const char* description;
  const char* examples;
};

// Adds a verb with the options that all of them have.
std::pair<CLI::App*, SharedOptions> add_verb(CLI::App& app, const VerbText& text) {
  CLI::App* const verb = app.add_subcommand(text.name, text.description);
  auto options = std::make_shared<RemoteOptions>();
  add_run_folder_option(*verb, options->run);
  verb->add_flag("--json", options->json, "Print the reply as one JSON object");
  verb->footer(fmt::format("{}\n{}", text.examples, kExitCodes));
  return {verb, options};
}

// Prints a reply. Throws Refused if the controller refused.
void tell(const Reply& reply, bool as_json) {
  if (as_json) {
    fmt::print("{}\n", json_of(reply).dump());
  } else {
    for (const std::string& line : reply.lines) {
      fmt::print("{}\n", line);
    }
    fmt::print(reply.is_ok ? stdout : stderr, "{}\n", reply.text);
  }
  if (!reply.is_ok) {
    throw Refused{};
  }
}

// Prints a reply; one that lists parameters as a table.
void tell_parameters(const Reply& reply, bool as_json) {
  if (as_json || reply.lines.empty()) {
    tell(reply, as_json);
    return;
  }
  fmt::print("{}", parameter_table(reply.lines));
}

// Sends one line and returns the reply.
Reply ask(const RemoteOptions& options, const std::string& line) {
  // The reply to `list` takes a tick for every parameter of every object.
  constexpr std::chrono::minutes kLongList(1);
  const bool is_of_object = line == "list" || line.find(" object.") != std::string::npos;
  Reply reply;
  with_controller(options.run, {.images = is_of_object},
                  [&](const std::filesystem::path& folder, const LineSession* /*line*/) {
                    Remote remote(folder);
                    reply = remote.send(line, line == "list" ? std::chrono::milliseconds(kLongList)
                                                             : std::chrono::milliseconds(5000));
                  });
  return reply;
}

// Sends one line and prints the reply.
void tell(const RemoteOptions& options, const std::string& line) {
  tell(ask(options, line), options.json);
}

// Starts homing, and waits until it is over if the user asks for that.
void home(const std::filesystem::path& folder, const RemoteOptions& options) {
  Remote remote(folder);
  const Reply started = remote.send("home");
  if (!options.wait || !started.is_ok || !options.json) {
    tell(started, options.json);
  }
  while (options.wait) {
    const Reply status = remote.send("status");
    const std::string mode = field_of(status.text, "mode").value_or("");
    if (mode != "homing") {
      if (options.json) {
        tell(status, true);
      } else {
        fmt::print(mode == "ready" ? stdout : stderr, "{}\n", status.text);
      }
      if (mode != "ready") {
        throw Refused{};
      }
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// Sends the emergency stop and prints the reply. On a line it goes before anything else.
void stop(const RemoteOptions& options) {
  const RunFolderOption& run = options.run;
  tell(run.serial.empty() ? send_stop(run.folder())
                          : send_stop_over_line(parse_serial_place(run.serial)),
       options.json);
}

void add_requests(CLI::App& app) {
  constexpr auto kRequests = std::to_array<VerbText>({
      {"enable", "Let the running controller put force on the hand",
       "Works in the mode `ready`; the force rises softly.\n\nExamples:\n  tactus home --wait && "
       "tactus enable\n  tactus enable --device 2             the second of several devices\n  "
       "tactus enable --device left          the one of left.tactus\n  tactus enable --serial "
       "/dev/ttyACM0  a bare "
       "board at the other end of a line"},
      {"disable", "Take the force away; the mode is then `ready`", "Example:\n  tactus disable"},
      {"reset", "Leave the mode `fault`, once its cause is gone",
       "Force comes back only through home and enable.\n\nExample:\n  tactus reset && tactus home "
       "--wait && tactus enable"},
      {"estop", "Stop at once: no force, brakes, mode `fault`",
       "It has a socket and a thread of its own: nothing else delays it. Not instead of an "
       "emergency stop that cuts the "
       "power.\n\nExample:\n  tactus estop"},
      {"status", "Say the mode, the faults and the scene of the running controller",
       "Examples:\n  tactus status\n  tactus status --json | jq -r .mode"},
  });
  for (const VerbText& text : kRequests) {
    auto [verb, options] = add_verb(app, text);
    verb->callback([options, name = std::string(text.name)] {
      if (name == "estop") {
        stop(*options);
      } else {
        tell(*options, name);
      }
    });
  }
  auto [verb, options] = add_verb(app, {"home", "Let the device find its reference",
                                        "Example:\n  tactus home --wait && tactus enable"});
  verb->add_flag("--wait", options->wait, "Until homing is over");
  verb->callback([options] {
    with_controller(options->run, {},
                    [&](const std::filesystem::path& folder, const LineSession* /*line*/) {
                      home(folder, *options);
                    });
  });
}

void add_parameters(CLI::App& app) {
  auto [get, got] =
      add_verb(app, {"get", "Read a parameter of the running controller, or list them all",
                     "Examples:\n  tactus get\n  tactus get max_force_N\n  tactus get "
                     "object.bunny.stiffness_N_per_m\n  tactus get --json | jq "
                     "'.parameters[].name'"});
  get->add_option("name", got->name, "As `tactus get` lists it; an object by name or number");
  get->callback([options = got] {
    tell_parameters(ask(*options, options->name.empty() ? "list" : "get " + options->name),
                    options->json);
  });

  auto [set, change] =
      add_verb(app, {"set", "Change a parameter of the running controller",
                     "Its limits may become gentler than the device's file says, never "
                     "harder. The contact method and the friction model of an object have the "
                     "names of scenes; lift the tool to change them.\n\nExamples:\n  tactus set "
                     "max_force_N 4\n  tactus set object.bunny.stiffness_N_per_m 600\n  tactus get "
                     "object.bunny.contact              the allowed ones, too\n  tactus "
                     "set object.bunny.contact one_plane    the textbook's god-object\n  tactus "
                     "set object.bunny.friction_model lugre"});
  set->add_option("name", change->name, "As `tactus get` lists it")->required();
  set->add_option("value", change->value,
                  "In the unit of its name, or a name that `tactus get` lists")
      ->required();
  set->callback(
      [options = change] { tell(*options, "set " + options->name + " " + options->value); });
}

void add_scene(CLI::App& app) {
  auto [verb, options] =
      add_verb(app, {"scene", "Let the running controller touch another scene",
                     "Not while the mode is `active`. The controller reads the file itself: it has "
                     "to be on its machine.\n\nExample:\n  tactus bake bunny.toml && tactus "
                     "disable && tactus scene bunny.tactus && tactus enable"});
  verb->add_option("file", options->file, "Scene image (.tactus)")->required();
  verb->callback(
      [options] { tell(*options, "scene " + std::filesystem::absolute(options->file).string()); });
}

// Records a board's ticks in this process, until the user ends it.
void record_line(const RemoteOptions& options) {
  if (options.value == "off") {
    throw InputError("with --serial a recording ends by Ctrl-C or --seconds");
  }
  if (options.file.empty()) {
    throw InputError("name the recording: tactus record on run.mcap --serial " +
                     options.run.serial);
  }
  check_recording_place(options.file, options.may_overwrite);
  const PrivateFolder folder;
  GatewayOptions gateway_of = gateway_options(options.run.serial);
  gateway_of.run_dir = folder.path();
  gateway_of.record = options.file;
  LineGateway gateway(std::move(gateway_of));
  run_gateway(gateway, options.seconds, options.file);
}

void add_record(CLI::App& app) {
  auto [verb, options] = add_verb(
      app, {"record", "Start or stop recording the running controller's ticks",
            "The controller writes the file, in its folder of recordings; its reply names it. With "
            "--serial this program writes it, until Ctrl-C.\n\nExamples:\n  tactus record on "
            "press.mcap\n  tactus record off\n  tactus record on run.mcap --serial "
            "unix:board.sock --seconds 10 && tactus replay run.mcap"});
  verb->add_option("switch", options->value, "on or off")
      ->required()
      ->check(CLI::IsMember({"on", "off"}));
  verb->add_option("file", options->file, "Name of the recording; needed with on");
  verb->add_flag("--overwrite", options->may_overwrite,
                 "With --serial: replace a file that is there; otherwise it is kept")
      ->needs(verb->get_option("--serial"));
  verb->add_option("--seconds", options->seconds, "With --serial: end after so long")
      ->needs(verb->get_option("--serial"))
      ->check(CLI::NonNegativeNumber);
  verb->callback([options] {
    if (!options->run.serial.empty()) {
      record_line(*options);
      return;
    }
    tell(*options, options->value == "on" ? "record on " + options->file : "record off");
  });
}

void add_inject(CLI::App& app) {
  auto [verb, options] = add_verb(
      app,
      {"inject", "Let the running controller meet a fault, for tests and drills",
       "Only where the controller was started with --allow-inject. Faults: drop, stuck, jump, nan, "
       "encoder, drive, estop_line, lost, not_ready, delay.\n\nExamples:\n  tactus inject "
       "estop_line\n  tactus inject drop 2\n  tactus inject delay 3"});
  verb->add_option("fault", options->name, "Its name")->required();
  verb->add_option("ticks", options->ticks, "For so many ticks")->capture_default_str();
  verb->callback(
      [options] { tell(*options, fmt::format("inject {} {}", options->name, options->ticks)); });
}

}  // namespace

void add_remote_verbs(CLI::App& app) {
  add_requests(app);
  add_parameters(app);
  add_scene(app);
  add_record(app);
  add_inject(app);
}

}  // namespace tactus::host
