// A folder for files that nobody needs when the work is done.
#pragma once

#include <filesystem>

namespace tactus::host {

// A private folder below the system's folder for temporary files, removed with its content at the
// end.
class PrivateFolder {
 public:
  // Throws InputError if no folder can be made.
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  PrivateFolder(PrivateFolder&&) = delete;
  PrivateFolder& operator=(PrivateFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tactus::host
