// A folder for files that nobody needs when the work is done.
#pragma once

#include <filesystem>

namespace tactus::host {

// A private folder, removed with its content at the end.
class PrivateFolder {
 public:
  // Make a new folder in the system's folder for temporary files, or in `place`. They throw
  // InputError if none can be made.
  PrivateFolder();
  explicit PrivateFolder(const std::filesystem::path& place);
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
