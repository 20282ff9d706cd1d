// Runs gnuplot on a script and the pictures that it needs. All figures go through it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/plot/silhouette.h"

namespace tactus::host {

// A private folder below the system's folder for temporary files, removed with its content at the
// end.
class TemporaryFolder {
 public:
  // Throws InputError if no folder can be made.
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

// Writes the picture as raw red-green-blue bytes for gnuplot's `binary` plots. Throws InputError.
void write_raw_rgb(const std::filesystem::path& file, const GreyImage& image);

// Returns the beginning of a script that draws several panels into the folder's picture, `width` by
// `height` pixels. A name of the user's never goes into a script as a file, since gnuplot runs a
// file name that begins with | as a command.
std::string picture_head(const TemporaryFolder& folder, double width, double height);

// Runs gnuplot on the script, and writes the folder's picture to `png` once it is complete. Throws
// InputError if gnuplot is not installed or fails, or `png` cannot be written.
void run_gnuplot(const TemporaryFolder& folder, std::string_view script,
                 const std::filesystem::path& png);

// Returns the text in gnuplot's single quotes, with blanks for control characters: a line end would
// begin a command.
std::string gnuplot_string(std::string_view text);

}  // namespace tactus::host
