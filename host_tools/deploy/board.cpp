#include "host_tools/deploy/board.h"

#include <fmt/format.h>

#include "host_tools/input_error.h"
#include "host_tools/programs/external_program.h"

namespace tactus::host {

Board::Board(const BoardAddress& address) : target_(address.target) {
  if (target_.empty() || target_.starts_with('-') ||
      target_.find_first_of(" \t\n") != std::string::npos) {
    throw InputError(fmt::format("{}: write the board as for ssh, like pi@board", target_));
  }
  ssh_ = "ssh";
  if (!address.identity.empty()) {
    ssh_ += " -i " + shell_quoted(address.identity);
  }
  for (const std::string& option : address.options) {
    ssh_ += " -o " + shell_quoted(option);
  }
  // A lost connection is noticed within a quarter of a minute. Of an option that is there twice,
  // ssh takes the first.
  ssh_ += " -o ConnectTimeout=10 -o ServerAliveInterval=5 -o ServerAliveCountMax=3";
  ssh_ += " -- " + shell_quoted(target_);
}

std::string Board::ssh(const std::string& command) const {
  return ssh_ + " " + shell_quoted(command);
}

int Board::run(const std::string& command, const OnLine& line) const {
  return run_lines(ssh(command) + " </dev/null", line);
}

int Board::send(const std::filesystem::path& folder, const std::string& command,
                const OnLine& line) const {
  return run_lines(fmt::format("tar -C {} -cf - . | {}", shell_quoted(folder), ssh(command)), line);
}

}  // namespace tactus::host
