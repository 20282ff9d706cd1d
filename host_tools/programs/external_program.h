// Runs other programs: valgrind, cyclictest, npm and tar for the benchmark, ssh for deployments.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tactus::host {

// Runs a command in a shell, without its output. Returns true if it ended with exit code 0.
bool command_succeeds(const std::string& command);

// Runs a command in a shell and hands over each line of its output, without the line end, as soon
// as it is there. The command's errors go to this program's stderr. Returns its exit code, or 127
// if no shell can be started, or -1 if a signal ended it.
int run_lines(const std::string& command, const std::function<void(std::string_view)>& line);

// Returns the path quoted as one word of a shell command.
std::string shell_quoted(const std::filesystem::path& path);

}  // namespace tactus::host
