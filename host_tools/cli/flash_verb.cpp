#include "host_tools/cli/flash_verb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host_tools/flash/board_program.h"
#include "host_tools/flash/emulated_board.h"
#include "host_tools/flash/flash_tool.h"
#include "host_tools/programs/external_program.h"
#include "host_tools/serial/serial_place.h"

namespace tactus::host {
namespace {

constexpr const char* kFlashExamples =
    "Writes a program to a board without an operating system, checks it and restarts the board.\n"
    "The motors have no power meanwhile if the board's switch is off at a reset, as it has to be.\n"
    "--emulate runs the program in QEMU instead and says where its UART is; Ctrl-C ends it.\n"
    "\n"
    "Exit codes: 0 written, or the emulator was ended; 1 the tool or the emulator failed; 2 "
    "nothing\n"
    "was done: a tool, a program or an option is missing.\n"
    "\n"
    "Examples:\n"
    "  firmware/mps2_an500/run.sh --build && tactus flash --emulate\n"
    "  tactus monitor --serial unix:board.sock              in another terminal\n"
    "  tactus flash board.elf --config interface/stlink.cfg --config target/stm32h7x.cfg\n"
    "  tactus flash board.elf --config board/my.cfg --dry-run\n"
    "  tactus flash board.elf --with 'pyocd flash -t stm32h743xx {file}'\n"
    "  tactus flash board.elf --with 'st-flash --format ihex write {file}'";

// The verb's options as the user gave them.
struct FlashOptions {
  std::string program;
  std::vector<std::string> configs;
  std::string with;
  EmulatedBoard board;
  bool emulate = false;
  bool dry_run = false;
};

// The exit code if the tool or the emulator failed.
constexpr int kToolFailed = 1;

// Prints QEMU's command line, or runs the board.
void emulate(EmulatedBoard board, bool dry_run) {
  if (dry_run) {
    check_board_program(board.program);
    std::vector<std::string> words;
    for (const std::string& word : emulator_command(board)) {
      words.push_back(shell_quoted(word));
    }
    fmt::print("{}\n", fmt::join(words, " "));
    return;
  }
  const bool is_done = run_emulated_board(board, [&board] {
    fmt::print("the board's line: {}{}\n", kSocketPrefix, board.line);
    fmt::print("it starts when a program opens the line; try: tactus monitor --serial {}{}\n",
               kSocketPrefix, board.line);
    std::fflush(stdout);
  });
  if (!is_done) {
    fmt::print(stderr, "tactus flash: the emulator has ended by itself; its message is above\n");
    throw CLI::RuntimeError(kToolFailed);
  }
}

// Prints the command, and runs it unless this is a dry run.
void write_program(const FlashOptions& options) {
  const std::string command =
      flash_command({.program = options.program, .configs = options.configs, .with = options.with});
  fmt::print("{}\n", command);
  if (options.dry_run) {
    return;
  }
  if (!run_flash_command(command)) {
    fmt::print(stderr,
               "tactus flash: the program was not written; the tool's message is above. Is the "
               "probe connected, and does the board have power?\n");
    throw CLI::RuntimeError(kToolFailed);
  }
  fmt::print("{} is on the board, which has restarted\n", options.program);
}

void run_flash(FlashOptions& options) {
  if (options.emulate) {
    options.board.program = options.program;
    emulate(options.board, options.dry_run);
  } else {
    write_program(options);
  }
}

}  // namespace

void add_flash_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("flash", "Write a program to a bare board, or run it in an emulator");
  const auto options = std::make_shared<FlashOptions>();
  options->program = kDefaultBoardProgram;
  verb->add_option("program", options->program, "The linked program (ELF)")->capture_default_str();
  CLI::Option* const config = verb->add_option(
      "--config", options->configs, "OpenOCD's file for the probe or the board; may be repeated");
  config->allow_extra_args(false);
  CLI::Option* const with = verb->add_option(
      "--with", options->with, "Your tool's command line, with {file} in place of the program");
  with->envname("TACTUS_FLASH");
  CLI::Option* const emulate =
      verb->add_flag("--emulate", options->emulate, "Run the program in QEMU");
  emulate->excludes(config);
  verb->add_option("--line", options->board.line,
                   "With --emulate: the Unix socket that the board's UART is on")
      ->needs(emulate)
      ->capture_default_str();
  verb->add_option("--machine", options->board.machine, "With --emulate: QEMU's name of the board")
      ->needs(emulate)
      ->capture_default_str();
  verb->add_flag("--dry-run", options->dry_run, "Print the command, and change nothing");
  verb->footer(kFlashExamples);
  verb->callback([options] { run_flash(*options); });
}

}  // namespace tactus::host
