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

// Runs gnuplot on the script, which is kept in the folder as script.gp. Throws InputError: gnuplot
// is not installed, or what it complained about.
void run_gnuplot(const TemporaryFolder& folder, std::string_view script);

// Begins a script that draws several panels into one PNG of that many pixels.
std::string picture_head(const std::filesystem::path& png, double width, double height);

// A string in gnuplot's single quotes.
std::string gnuplot_string(std::string_view text);

}  // namespace tactus::host
