#include "host_tools/files/output_place.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Linux's major numbers of character devices, and the minor numbers of those among them that are
// safe to write to: Documentation/admin-guide/devices.txt.
constexpr unsigned kMemoryDevices = 1;
constexpr unsigned kNull = 3;
constexpr unsigned kFull = 7;
constexpr unsigned kOwnTerminal = 5;  // minor 0: /dev/tty
constexpr unsigned kFirstPseudoTerminal = 136;
constexpr unsigned kLastPseudoTerminal = 143;

// Returns what the system knows of the file that the path leads to; nothing if there is none.
std::optional<struct stat> status_of(const std::filesystem::path& path) {
  struct stat status{};
  return ::stat(path.c_str(), &status) == 0 ? std::optional(status) : std::nullopt;
}

// Returns true if the file takes a stream of bytes and no stored data is lost by it: pipes,
// sockets, terminals, /dev/null and /dev/full. A disk or a serial port is a device that would be
// overwritten.
bool takes_a_stream(const struct stat& status) {
  if (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode)) {
    return true;
  }
  if (!S_ISCHR(status.st_mode)) {
    return false;
  }
  const unsigned kind = major(status.st_rdev);
  const unsigned which = minor(status.st_rdev);
  return (kind == kMemoryDevices && (which == kNull || which == kFull)) ||
         (kind == kOwnTerminal && which == 0) ||
         (kind >= kFirstPseudoTerminal && kind <= kLastPseudoTerminal);
}

// Returns true if both names lead to one regular file: device and inode number are equal, so hard
// links and symbolic links are found out too.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::optional<struct stat> first = status_of(a);
  const std::optional<struct stat> second = status_of(b);
  return first && second && S_ISREG(first->st_mode) && first->st_dev == second->st_dev &&
         first->st_ino == second->st_ino;
}

// Returns true if two outputs would be written to the same path. Outputs need not exist yet, so the
// paths are compared and not the inodes; two outputs may share standard output.
bool is_same_place(const std::filesystem::path& a, const std::filesystem::path& b) {
  return !a.empty() && !is_standard_output(a) && !is_standard_output(b) &&
         std::filesystem::weakly_canonical(a) == std::filesystem::weakly_canonical(b);
}

// Throws InputError with the reason and that nothing was written.
[[noreturn]] void refuse(const std::filesystem::path& output, std::string_view why) {
  throw InputError(fmt::format("{}: {}; nothing was written", output.string(), why));
}

// Returns the target of a symbolic link, so that the rename replaces the target and the link stays;
// any other path is returned unchanged.
std::filesystem::path followed(const std::filesystem::path& output) {
  std::error_code error;
  if (!std::filesystem::is_symlink(output, error)) {
    return output;
  }
  const std::filesystem::path target = std::filesystem::canonical(output, error);
  if (error) {
    refuse(output, "is a link to nothing that is there; name the file itself");
  }
  return target;
}

// Accepts a stream, unless the program needs a file.
OutputPlace pipe_place(const std::filesystem::path& output, OutputKind kind) {
  if (kind == OutputKind::file) {
    refuse(output, "is a pipe or a terminal, and this output must be a file; name one");
  }
  return {.file = output, .is_pipe = true};
}

}  // namespace

OutputPlace output_place(const std::filesystem::path& output, OutputKind kind) {
  if (output == "-") {
    refuse(output, "is no file name here; for standard output write /dev/stdout");
  }
  const std::optional<struct stat> status = status_of(output);
  if (is_standard_output(output)) {
    return pipe_place(output, kind);
  }
  if (!status) {
    return {.file = followed(output)};
  }
  if (S_ISDIR(status->st_mode)) {
    refuse(output, "is a folder; name a file in it");
  }
  if (takes_a_stream(*status)) {
    return pipe_place(output, kind);
  }
  if (!S_ISREG(status->st_mode)) {
    refuse(output, "is a device; name a file");
  }
  const std::filesystem::path file = followed(output);
  if (::access(file.c_str(), W_OK) != 0) {
    refuse(output, "may not be written to by you; name another file or change its permissions");
  }
  return {.file = file};
}

void keep_inputs_safe(std::span<const std::filesystem::path> outputs,
                      std::span<const std::filesystem::path> inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const std::filesystem::path& input : inputs) {
      if (is_same_file(outputs[i], input)) {
        refuse(outputs[i],
               fmt::format("is the input {}, which would be lost; name another file for the output",
                           input.string()));
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (is_same_place(outputs[i], outputs[j])) {
        refuse(outputs[i], "is named for two outputs; give each a file of its own");
      }
    }
  }
}

void keep_inputs_safe(std::initializer_list<std::filesystem::path> outputs,
                      std::initializer_list<std::filesystem::path> inputs) {
  keep_inputs_safe(std::span(outputs.begin(), outputs.size()),
                   std::span(inputs.begin(), inputs.size()));
}

void keep_images_safe(const std::filesystem::path& output) {
  // The first bytes of the two formats: rendering/scene/image_format.h, firmware/device.
  constexpr std::array<std::string_view, 2> kMagics = {"TACTUS\r\n", "TACDEV\r\n"};
  const std::optional<struct stat> status = status_of(output);
  if (!status || !S_ISREG(status->st_mode)) {
    return;
  }
  std::array<char, 8> start{};
  std::ifstream file(output, std::ios::binary);
  file.read(start.data(), start.size());
  for (const std::string_view magic : kMagics) {
    if (std::string_view(start.data(), start.size()) == magic) {
      refuse(output, "is a baked image, which would be lost; name another file for the output");
    }
  }
}

std::filesystem::path partial_of(const OutputPlace& place) {
  return fmt::format("{}.{}.partial", place.file.string(), ::getpid());
}

void check_recording_place(const std::filesystem::path& file, bool may_overwrite) {
  if (file.empty()) {
    return;
  }
  if (file.extension() != ".mcap" && file.extension() != ".csv") {
    throw InputError(fmt::format(
        "{}: the name of a recording ends in .mcap, or in .csv for a table", file.string()));
  }
  keep_images_safe(file);
  (void)output_place(file, OutputKind::file);
  if (!may_overwrite && std::filesystem::exists(file)) {
    throw InputError(fmt::format(
        "{}: this file is there and is kept; name another, or say --overwrite", file.string()));
  }
}

void make_folder_of(const std::filesystem::path& file) {
  std::error_code failure;
  if (file.has_parent_path()) {
    std::filesystem::create_directories(file.parent_path(), failure);
  }
  if (failure) {
    throw InputError(fmt::format("{}: {}", file.parent_path().string(), failure.message()));
  }
}

bool is_standard_output(const std::filesystem::path& output) {
  return output == "/dev/stdout" || output == "/dev/fd/1" || output == "/proc/self/fd/1";
}

std::filesystem::path file_of_tool(const std::filesystem::path& file, std::size_t tool) {
  if (file.empty() || tool == 0) {
    return file;
  }
  return file.parent_path() /
         fmt::format("{}.{}{}", file.stem().string(), tool + 1, file.extension().string());
}

void refuse_shared_pipe(const std::filesystem::path& output, std::size_t tools) {
  if (tools > 1 && !output.empty() && output_place(output, OutputKind::may_be_a_pipe).is_pipe) {
    throw InputError(
        fmt::format("{}: is a pipe or a terminal, which takes the rows of one tool, and there are "
                    "{}; name a file; nothing was written",
                    output.string(), tools));
  }
}

}  // namespace tactus::host
