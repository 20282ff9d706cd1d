// Runs programs as a user does.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/support/paths.h"

namespace tactus::testing {

struct Outcome {
  int exit_code = -1;
  std::string output;  // of stdout and stderr, together
};

// Runs a command of the shell in a folder.
inline Outcome run_command(const std::filesystem::path& folder, const std::string& command) {
  const std::string line = "cd '" + folder.string() + "' && " + command + " 2>&1";
  Outcome result;
  FILE* pipe = ::popen(line.c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t n = 1; n != 0;) {
    n = std::fread(buffer.data(), 1, buffer.size(), pipe);
    result.output.append(buffer.data(), n);
  }
  const int status = ::pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

// Runs tactus in a folder.
inline Outcome run_program(const std::filesystem::path& folder, const std::string& arguments) {
  return run_command(folder, "'" + built_program("tactus") + "' " + arguments);
}

}  // namespace tactus::testing
