#include "host_tools/cli/init_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "host_tools/init/device_folder.h"
#include "host_tools/init/plan_questions.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kInitExamples =
    "Writes device.toml, scene.toml and README.md for a device of your own. They bake, simulate "
    "and "
    "certify as they are,\n"
    "before the device exists. On a terminal it asks what no option says; Enter takes the answer "
    "in "
    "brackets. Nothing that\n"
    "is there is overwritten.\n"
    "\n"
    "Examples:\n"
    "  tactus init arm                          asks ten questions, and writes into the folder "
    "arm\n"
    "  tactus init arm lab --yes                takes every usual answer\n"
    "  tactus init arm lab --yes --drive moteus_canfd --lengths 0.25,0.22,0.1 --ratio 16,12,12\n"
    "  tactus init arm desk --yes --mechanism pantograph --drive odrive_can\n"
    "  then: cd lab && tactus inspect device.toml --figure reach.png";

// An option that answers a question.
struct InitAnswer {
  const char* option;
  const char* help;
};
constexpr std::array<InitAnswer, 10> kInitAnswers{
    {{"mechanism", "serial_arm, delta, pantograph, paddle or cartesian"},
     {"drive",
      "odrive_can, moteus_canfd, cia402_can, vesc_can, gpio_axis, falcon_usb or haply_serial"},
     {"lengths", "Lengths of the mechanism, m, with commas between them"},
     {"handle-kg", "Mass of the handle"},
     {"ratio", "Turns of a motor for a turn of its joint: one for all, or one for each"},
     {"counts", "Counts of an encoder for a turn of its motor"},
     {"torque-Nm", "Largest torque of a motor at its shaft"},
     {"torque-constant", "Of VESCs: torque constant of the motors, N m/A"},
     {"connection", "CAN interface, serial port or GPIO chip"},
     {"rate-hz", "Ticks a second"}}};

// The verb's options as the user gave them.
struct InitOptions {
  std::string folder = "arm";
  bool yes = false;
  std::map<std::string, std::string, std::less<>> answers;
};

// Asks on the terminal until the answer can be read.
void ask_on_terminal(const PlanQuestion& question, const ReadAnswer& read) {
  while (true) {
    fmt::print("{}\n  [{}] ", question.text, question.usual);
    std::fflush(stdout);
    std::string line;
    if (!std::getline(std::cin, line)) {
      throw InputError("the answers ended; nothing has been written");
    }
    try {
      read(line.empty() ? question.usual : line);
      return;
    } catch (const InputError& error) {
      fmt::print("  {}\n", error.what());
    }
  }
}

// Takes the answer of the option, of the terminal, or the usual one.
void answer(const InitOptions& options, const PlanQuestion& question, const ReadAnswer& read) {
  const auto given = options.answers.find(question.option);
  if (given == options.answers.end() || given->second.empty()) {
    if (options.yes) {
      read(question.usual);
    } else {
      ask_on_terminal(question, read);
    }
    return;
  }
  try {
    read(given->second);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--{}: {}", question.option, error.what()));
  }
}

void run_init(const InitOptions& options) {
  refuse_taken_folder(options.folder);
  if (!options.yes && (::isatty(STDIN_FILENO) != 1 || ::isatty(STDOUT_FILENO) != 1)) {
    throw InputError(
        "there is no terminal to ask on; --yes takes the usual answer where no option has one");
  }
  const DevicePlan plan = ask_plan([&](const PlanQuestion& question, const ReadAnswer& read) {
    answer(options, question, read);
  });
  for (const std::filesystem::path& file : write_device_folder(plan, options.folder)) {
    fmt::print("{}\n", file.string());
  }
  fmt::print(
      "next: cd {} && tactus inspect device.toml --figure reach.png; README.md has the rest\n",
      options.folder);
}

}  // namespace

void add_init_verb(CLI::App& app) {
  CLI::App* const verb =
      app.add_subcommand("init", "Begin a device of your own: its files and the next steps");
  verb->require_subcommand(1);
  CLI::App* const arm = verb->add_subcommand("arm", "A haptic device, by ten questions");
  const auto options = std::make_shared<InitOptions>();
  arm->add_option("folder", options->folder, "Folder to write into")->capture_default_str();
  arm->add_flag("--yes", options->yes, "Take the usual answer where no option has one");
  for (const InitAnswer& known : kInitAnswers) {
    arm->add_option(fmt::format("--{}", known.option), options->answers[known.option], known.help);
  }
  verb->footer(kInitExamples);
  arm->footer(kInitExamples);
  arm->callback([options] { run_init(*options); });
}

}  // namespace tactus::host
