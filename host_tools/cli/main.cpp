// The `tactus` program: one verb a task, each in <verb>_verb.cpp.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "host_tools/cli/bake_verb.h"
#include "host_tools/cli/bench_verb.h"
#include "host_tools/cli/certify_verb.h"
#include "host_tools/cli/commission_verb.h"
#include "host_tools/cli/compare_verb.h"
#include "host_tools/cli/completion.h"
#include "host_tools/cli/demo_verb.h"
#include "host_tools/cli/deploy_verb.h"
#include "host_tools/cli/doctor_verb.h"
#include "host_tools/cli/emulate_verb.h"
#include "host_tools/cli/export_verb.h"
#include "host_tools/cli/faults_verb.h"
#include "host_tools/cli/fit_verb.h"
#include "host_tools/cli/flash_verb.h"
#include "host_tools/cli/foxglove_verb.h"
#include "host_tools/cli/friction_verb.h"
#include "host_tools/cli/init_verb.h"
#include "host_tools/cli/inspect_verb.h"
#include "host_tools/cli/line_verb.h"
#include "host_tools/cli/monitor_verb.h"
#include "host_tools/cli/plot_verb.h"
#include "host_tools/cli/remote_verbs.h"
#include "host_tools/cli/replay_verb.h"
#include "host_tools/cli/sim_verb.h"
#include "host_tools/cli/touch_verb.h"
#include "host_tools/input_error.h"
#include "host_tools/nearest_name.h"
#include "host_tools/remote/remote.h"
#include "host_tools/terminal_colour.h"

namespace {

// The exit codes of all verbs; host_tools/cli/README.md lists them. Some verbs have the same number
// for outcomes of their own.
enum ExitCode : int {
  kOk = 0,
  kInternalFailure = 1,
  kRefused = 1,
  kBadInput = 2,
  kUnreachable = 2,
  kNotWritten = 2
};

using AddVerb = void (*)(CLI::App& app);

// The verbs in the order of --help.
constexpr std::array kVerbs = {
    AddVerb{tactus::host::add_demo_verb},       AddVerb{tactus::host::add_bake_verb},
    AddVerb{tactus::host::add_inspect_verb},    AddVerb{tactus::host::add_touch_verb},
    AddVerb{tactus::host::add_sim_verb},        AddVerb{tactus::host::add_plot_verb},
    AddVerb{tactus::host::add_bench_verb},      AddVerb{tactus::host::add_friction_verb},
    AddVerb{tactus::host::add_fit_verb},        AddVerb{tactus::host::add_emulate_verb},
    AddVerb{tactus::host::add_faults_verb},     AddVerb{tactus::host::add_doctor_verb},
    AddVerb{tactus::host::add_deploy_verb},     AddVerb{tactus::host::add_flash_verb},
    AddVerb{tactus::host::add_replay_verb},     AddVerb{tactus::host::add_export_verb},
    AddVerb{tactus::host::add_remote_verbs},    AddVerb{tactus::host::add_certify_verb},
    AddVerb{tactus::host::add_commission_verb}, AddVerb{tactus::host::add_monitor_verb},
    AddVerb{tactus::host::add_watch_verb},      AddVerb{tactus::host::add_line_verb},
    AddVerb{tactus::host::add_compare_verb},    AddVerb{tactus::host::add_foxglove_verb},
    AddVerb{tactus::host::add_init_verb},
};

// Returns "tactus bake", or "tactus" before a verb is known.
std::string name_of_run(const CLI::App& app) {
  const auto verbs = app.get_subcommands();
  return verbs.empty() ? app.get_name() : app.get_name() + " " + verbs.front()->get_name();
}

// Prints one line to stderr and returns the exit code.
int report(const CLI::App& app, std::string_view message, ExitCode code) {
  // If stderr cannot be written either, only the exit code is left to report the failure.
  const std::string name = name_of_run(app) + ":";
  const bool colours = tactus::host::has_colour(stderr);
  std::fputs(
      fmt::format("{} {}\n",
                  colours ? tactus::host::coloured(name, tactus::host::TerminalColour::red) : name,
                  message)
          .c_str(),
      stderr);
  return code;
}

// Returns "did you mean 'bake'? ", or nothing if no name is near.
std::string advice(const tactus::host::NearestName& nearest) {
  const auto meant = nearest.found();
  return meant ? fmt::format("did you mean '{}'? ", *meant) : "";
}

// Returns advice for an option that the verb does not have, from CLI11's text, which ends with the
// words that were not expected.
std::string option_advice(const CLI::App& verb, std::string_view text) {
  const std::size_t begin = text.find("--");
  if (begin == std::string_view::npos) {
    return "";
  }
  const std::string written(text.substr(begin, text.find_first_of(" =", begin) - begin));
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  tactus::host::NearestName nearest(written);
  for (const std::string& name : names) {
    nearest.consider(name);
  }
  return advice(nearest);
}

// Handles the ways in which CLI11 ends parsing. Help and version are no errors, nor is a verb that
// ends with an exit code of its own by CLI::RuntimeError. Everything else is a wrong command line.
int report_usage(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0 || error.get_name() == "RuntimeError") {
    return app.exit(error);
  }
  const auto verbs = app.get_subcommands();
  const CLI::App& verb = verbs.empty() ? app : *verbs.front();
  const bool is_unknown = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  const std::string meant = is_unknown ? option_advice(verb, error.what()) : "";
  return report(app, fmt::format("{}; {}see {} --help", error.what(), meant, name_of_run(app)),
                kBadInput);
}

// Reports a missing or unknown verb; CLI11 would only say that a subcommand is required.
void require_verb(const CLI::App& app, std::span<char*> arguments) {
  const std::string_view first = arguments.size() > 1 ? arguments[1] : "";
  if (first.empty()) {
    throw tactus::host::InputError("say what to do; tactus --help lists the verbs");
  }
  tactus::host::NearestName nearest(first);
  bool is_known = first.starts_with('-');
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    nearest.consider(verb->get_name());
    is_known = is_known || verb->get_name() == first;
  }
  if (!is_known) {
    throw tactus::host::InputError(
        fmt::format("there is no verb '{}'; {}tactus --help lists them", first, advice(nearest)));
  }
}

// Returns `code` if all of standard output was written. A full disk or a closed pipe shows only
// when the last bytes are flushed.
int with_output_written(const CLI::App& app, int code) {
  // A reader that has seen enough, such as head, closes the pipe: no error of anybody's.
  if ((std::fflush(stdout) == 0 && std::ferror(stdout) == 0) || errno == EPIPE) {
    return code;
  }
  return report(app,
                fmt::format("standard output cannot be written: {}; its end is missing",
                            std::generic_category().message(errno)),
                kNotWritten);
}

// Prints what a shell may offer for the last word; see completion.h. It is no verb: its words are
// another command's.
int print_completions(const CLI::App& app, std::span<char*> words) {
  for (const std::string& word :
       tactus::host::completions(app, std::vector<std::string>(words.begin(), words.end()))) {
    fmt::print("{}\n", word);
  }
  return kOk;
}

int run(CLI::App& app, int argc, char** argv) {
  try {
    if (argc > 1 && std::string_view(argv[1]) == "complete") {
      return print_completions(app, std::span(argv, static_cast<std::size_t>(argc)).subspan(2));
    }
    require_verb(app, {argv, static_cast<std::size_t>(argc)});
    app.parse(argc, argv);
    return kOk;
  } catch (const CLI::ParseError& error) {
    return report_usage(app, error);
  } catch (const tactus::host::InputError& error) {
    return report(app, error.what(), kBadInput);
  } catch (const tactus::host::Refused&) {
    return kRefused;
  } catch (const tactus::host::UnreachableError& error) {
    return report(app, error.what(), kUnreachable);
  } catch (const std::exception& error) {
    // fmt throws if the buffer of standard output cannot be written; with_output_written() reports
    // that.
    if (std::ferror(stdout) != 0) {
      return kNotWritten;
    }
    return report(app, fmt::format("internal failure: {}", error.what()), kInternalFailure);
  }
}

}  // namespace

// An exception that CLI11 throws while verbs are added is a mistake of this program.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app{"Bakes, runs and measures scenes for the Tactus haptic controller.", "tactus"};
  app.set_version_flag("--version", "tactus " TACTUS_VERSION);
  app.require_subcommand(1);
  app.footer("Every verb has its own help with examples: tactus bake --help");
  for (const AddVerb add : kVerbs) {
    add(app);
  }
  return with_output_written(app, run(app, argc, argv));
}
