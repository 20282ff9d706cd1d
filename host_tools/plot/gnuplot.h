// Running gnuplot on a script and the pictures that it needs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/plot/silhouette.h"

namespace tactus::host {

// A private folder under the system's temporary one, removed with everything in it at the end.
class TemporaryFolder {
 public:
  // Throws InputError, text for a user, where none can be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Writes the picture as raw red-green-blue bytes for gnuplot's `binary` plots. Throws
// InputError.
void write_raw_rgb(const std::filesystem::path& file, const GreyImage& image);

// Begins a script that draws several panels into the folder's picture, of that many pixels. No name
// of the user's goes into a script as a file: gnuplot runs a file name that begins with | as a
// command.
std::string picture_head(const TemporaryFolder& folder, double width, double height);

// Runs gnuplot on the script, then writes the folder's picture, once it is whole, to `png`. Throws
// InputError: gnuplot is not installed, it complained, or `png` cannot be written.
void run_gnuplot(const TemporaryFolder& folder, std::string_view script,
                 const std::filesystem::path& png);

// A string in gnuplot's single quotes, with spaces for control characters: a line end would begin
// a command.
std::string gnuplot_string(std::string_view text);

}  // namespace tactus::host
