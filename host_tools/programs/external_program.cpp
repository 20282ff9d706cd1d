#include "host_tools/programs/external_program.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>

namespace tactus::host {

bool command_succeeds(const std::string& command) {
  const std::string silent = "{ " + command + "; } >/dev/null 2>&1 </dev/null";
  return std::system(silent.c_str()) == 0;  // NOLINT(concurrency-mt-unsafe): one thread
}

int run_lines(const std::string& command, const std::function<void(std::string_view)>& line) {
  constexpr int kNoShell = 127;
  std::FILE* const pipe = ::popen(command.c_str(), "re");
  if (pipe == nullptr) {
    return kNoShell;
  }
  std::string text;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
    text += buffer.data();
    if (text.ends_with('\n')) {
      text.pop_back();
      line(text);
      text.clear();
    }
  }
  if (!text.empty()) {
    line(text);
  }
  const int status = ::pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string shell_quoted(const std::filesystem::path& path) {
  std::string quoted = "'";
  for (const char c : path.string()) {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

}  // namespace tactus::host
