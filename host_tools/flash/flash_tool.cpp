#include "host_tools/flash/flash_tool.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "host_tools/flash/board_program.h"
#include "host_tools/input_error.h"
#include "host_tools/install_command.h"
#include "host_tools/programs/external_program.h"

namespace tactus::host {
namespace {

constexpr std::string_view kFilePlace = "{file}";

// Returns the command with the program in each place of {file}.
std::string user_command(const FlashPlan& plan) {
  std::string command = plan.with;
  std::size_t at = command.find(kFilePlace);
  if (at == std::string::npos) {
    throw InputError("--with \"" + plan.with + "\": write {file} where the program's name goes");
  }
  if (!std::filesystem::is_regular_file(plan.program)) {
    throw InputError(plan.program + ": there is no such file");
  }
  const std::string quoted = shell_quoted(plan.program);
  for (; at != std::string::npos; at = command.find(kFilePlace, at + quoted.size())) {
    command.replace(at, kFilePlace.size(), quoted);
  }
  return command;
}

// Returns the word of OpenOCD's own language for a file: braces keep blanks together.
std::string openocd_word(const std::string& file) {
  if (file.find_first_of("{}\\") != std::string::npos) {
    throw InputError(file + ": OpenOCD takes no braces and backslashes in a file's name");
  }
  return "{" + file + "}";
}

std::string openocd_command(const FlashPlan& plan) {
  check_board_program(plan.program);
  std::string command = "openocd";
  for (const std::string& config : plan.configs) {
    command += " -f " + shell_quoted(config);
  }
  const std::string orders =
      fmt::format("program {} verify reset exit", openocd_word(plan.program));
  return command + " -c " + shell_quoted(orders);
}

}  // namespace

std::string flash_command(const FlashPlan& plan) {
  if (plan.configs.empty() == plan.with.empty()) {
    throw InputError(
        "say how the program is written: --config interface/stlink.cfg --config "
        "target/stm32h7x.cfg for OpenOCD, --with \"COMMAND {file}\" for a tool of your own, or "
        "--emulate for no board; one of them");
  }
  return plan.with.empty() ? openocd_command(plan) : user_command(plan);
}

bool run_flash_command(const std::string& command) {
  const std::string tool = command.substr(0, command.find(' '));
  if (tool == "openocd" && find_tool(tool).empty()) {
    throw InputError("openocd is not installed: " + install_command("openocd") +
                     "; --with takes another tool");
  }
  std::fflush(stdout);
  constexpr int kNoSuchTool = 127;
  const int code = run_lines(command, [](std::string_view line) {
    std::fprintf(stdout, "%.*s\n", static_cast<int>(line.size()), line.data());
    std::fflush(stdout);
  });
  if (code == kNoSuchTool) {
    throw InputError(
        fmt::format("{}: there is no such program; install it, or give another by "
                    "--with",
                    tool));
  }
  return code == 0;
}

}  // namespace tactus::host
