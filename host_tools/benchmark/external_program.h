// Runs other programs for the benchmark: valgrind, cyclictest, npm, tar.
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host {

// Runs a command in a shell, without its output. Returns true if it ended with exit code 0.
bool command_succeeds(const std::string& command);

// Returns the path quoted as one word of a shell command.
std::string shell_quoted(const std::filesystem::path& path);

// Creates a folder, and removes it with its content at the end of the scope.
class FolderGuard {
 public:
  // Throws std::filesystem::filesystem_error if the folder cannot be created.
  explicit FolderGuard(std::filesystem::path path);
  FolderGuard(const FolderGuard&) = delete;
  FolderGuard& operator=(const FolderGuard&) = delete;
  ~FolderGuard();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tactus::host
