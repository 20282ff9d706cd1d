#include "host_tools/flash/board_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The beginning of an ELF file: magic number, class and byte order; the processor is at the offset.
constexpr std::string_view kElfOf32Bits(
    "\x7f"
    "ELF\x01\x01",
    6);
constexpr std::size_t kProcessorOffset = 18;
constexpr unsigned char kArm = 40;

}  // namespace

void check_board_program(const std::filesystem::path& program) {
  const std::string name = program.string();
  std::error_code error;
  if (std::filesystem::is_directory(program, error)) {
    throw InputError(name + ": a folder; give the program in it");
  }
  std::ifstream stream(program, std::ios::binary);
  std::array<char, kProcessorOffset + 2> begin{};
  if (!stream) {
    throw InputError(fmt::format("{}: cannot be read: {}{}", name, std::strerror(errno),
                                 errno == ENOENT ? "; firmware/mps2_an500/run.sh --build makes " +
                                                       std::string(kDefaultBoardProgram)
                                                 : ""));
  }
  stream.read(begin.data(), begin.size());
  const std::string_view read(begin.data(), static_cast<std::size_t>(stream.gcount()));
  if (!read.starts_with("\x7f"
                        "ELF")) {
    throw InputError(name +
                     ": no linked program (ELF); give the linker's output. For a .hex or "
                     ".bin file give your own tool by --with");
  }
  if (read.size() < begin.size() || !read.starts_with(kElfOf32Bits) ||
      static_cast<unsigned char>(begin[kProcessorOffset]) != kArm) {
    throw InputError(name +
                     ": a program for another processor than a Cortex-M; build it with the "
                     "preset cortex-m7");
  }
}

std::filesystem::path find_tool(const std::string& name, const std::string& search) {
  if (name.find('/') != std::string::npos) {
    return ::access(name.c_str(), X_OK) == 0 ? std::filesystem::path(name) : "";
  }
  std::istringstream folders(search);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::error_code error;
    if (::access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file, error)) {
      return file;
    }
  }
  return {};
}

std::filesystem::path find_tool(const std::string& name) {
  const char* const search = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
  return find_tool(name, search == nullptr ? "" : search);
}

}  // namespace tactus::host
