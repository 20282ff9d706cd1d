#include "host_tools/plot/figures.h"

namespace tactus::host {
namespace {

// The beginning of the files' names, and their extension.
struct Naming {
  std::string prefix;
  std::string extension;
  // True if the user named a file and not a folder or a prefix.
  bool is_file = false;
};

// Returns true for an extension such as .jpg, false for none and for the end of a number.
bool looks_like_extension(const std::string& extension) {
  constexpr std::string_view kDigits = "0123456789";
  return extension.size() > 1 && kDigits.find(extension[1]) == std::string_view::npos;
}

Naming naming_of(const std::filesystem::path& output, const std::string& stem,
                 PictureFormat format) {
  const std::string extension(extension_of(format));
  if (std::filesystem::is_directory(output) || !output.has_filename()) {
    return {.prefix = (output / stem).string(), .extension = extension};
  }
  if (!looks_like_extension(output.extension().string())) {
    return {.prefix = output.string(), .extension = extension};
  }
  static_cast<void>(picture_format(output));
  return {.prefix = (output.parent_path() / output.stem()).string(),
          .extension = output.extension().string(),
          .is_file = true};
}

}  // namespace

FigureFiles figure_files(const std::filesystem::path& output, const std::string& stem,
                         PictureFormat format) {
  const Naming naming = naming_of(output, stem, format);
  const auto file = [&](std::string_view name) {
    return naming.prefix + std::string(name) + naming.extension;
  };
  return {.force = file("_force"), .path = file("_path"), .against = file("_against")};
}

std::filesystem::path figure_file(const std::filesystem::path& output, const std::string& stem,
                                  const std::string& name, PictureFormat format) {
  const Naming naming = naming_of(output, stem, format);
  return naming.is_file ? output : std::filesystem::path(naming.prefix + name + naming.extension);
}

}  // namespace tactus::host
