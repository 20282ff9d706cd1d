// Runs gnuplot on a script and the pictures that it needs. All figures go through it: a figure is a
// PNG, SVG or PDF file by the extension of its name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/files/private_folder.h"
#include "host_tools/plot/silhouette.h"

namespace tactus::host {

// The kind of a picture's file.
enum class PictureFormat : std::uint8_t { png, svg, pdf };

// Returns the format that the file's extension names, in small or large letters. Throws InputError
// that names the three if it names none of them. Verbs that work for long call it first.
PictureFormat picture_format(const std::filesystem::path& picture);

// Returns the format's extension with its dot.
std::string_view extension_of(PictureFormat format);

// The folder of gnuplot's script and of the pictures that it needs.
using GnuplotFolder = PrivateFolder;

// Writes the picture as raw red-green-blue bytes for gnuplot's `binary` plots. Throws InputError.
void write_raw_rgb(const std::filesystem::path& file, const GreyImage& image);
// Writes such bytes, three for each pixel.
void write_raw_rgb(const std::filesystem::path& file, std::string_view bytes);

// Returns the item of a plot command that draws such bytes, so many pixels, over a window in the
// unit of the axes.
std::string rgb_item(const std::filesystem::path& file, int columns, int rows,
                     const Window& window);

// A picture's size; of an SVG or PDF file in points, in which it has the same layout.
struct PictureSize {
  double width_px = 0.0;
  double height_px = 0.0;
};

// Runs gnuplot on a script that draws one or several panels, and writes the picture to `picture`
// once it is complete. Throws InputError if the name has another extension than picture_format()
// knows, gnuplot is not installed or fails, or `picture` cannot be written. The user's name is
// never in a script, since gnuplot runs a file name that begins with | as a command.
void run_gnuplot(const GnuplotFolder& folder, const PictureSize& size, std::string_view script,
                 const std::filesystem::path& picture);

// Returns 1, 2 or 5 times a power of ten, the smallest that is not below `least`; for the marks of
// an axis.
double round_step(double least);

// Returns the text in gnuplot's single quotes, with blanks for control characters: a line end would
// begin a command. Bytes that are not UTF-8 become question marks: no SVG file may hold them.
std::string gnuplot_string(std::string_view text);

}  // namespace tactus::host
