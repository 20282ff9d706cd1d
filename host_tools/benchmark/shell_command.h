// Other programs that the benchmark starts.
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host {

// Runs it in a shell, silently; whether it ended with 0.
bool command_succeeds(const std::string& command);

// As one word of a shell command, whatever characters it has.
std::string shell_quoted(const std::filesystem::path& path);

// A folder of one's own, made now and gone, with all that is in it, at the end of the scope. Throws
// std::filesystem::filesystem_error when it cannot be made.
class FolderGuard {
 public:
  explicit FolderGuard(std::filesystem::path path);
  FolderGuard(const FolderGuard&) = delete;
  FolderGuard& operator=(const FolderGuard&) = delete;
  ~FolderGuard();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tactus::host
