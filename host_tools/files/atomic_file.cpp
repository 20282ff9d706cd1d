#include "host_tools/files/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "host_tools/files/output_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the words of an errno.
std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  OutputFile file(path, OutputKind::may_be_a_pipe);
  file.write(bytes);
  file.commit();
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw InputError(fmt::format("{}: is a folder; name a file", path.string()));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) {
    throw InputError(fmt::format("{}: cannot read: {}; check the path and its permissions",
                                 path.string(), reason(errno)));
  }
  std::string text(static_cast<std::size_t>(file.tellg()), '\0');
  file.seekg(0);
  if (!file.read(text.data(), static_cast<std::streamsize>(text.size()))) {
    throw InputError(fmt::format("{}: cannot read to its end; check the disk", path.string()));
  }
  return text;
}

}  // namespace tactus::host
