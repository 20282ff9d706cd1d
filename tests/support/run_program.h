// Runs the tactus program as a user does.
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

inline Outcome run_program(const std::filesystem::path& folder, const std::string& arguments) {
  const std::string command =
      "cd '" + folder.string() + "' && '" + built_program("tactus") + "' " + arguments + " 2>&1";
  Outcome result;
  FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t n = 1; n != 0;) {
    n = std::fread(buffer.data(), 1, buffer.size(), pipe);
    result.output.append(buffer.data(), n);
  }
  const int status = ::pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

}  // namespace tactus::testing
