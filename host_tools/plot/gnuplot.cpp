#include "host_tools/plot/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <span>
#include <system_error>

#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr unsigned char kFirstPrintable = 0x20;
constexpr unsigned char kDelete = 0x7f;

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) {
    throw InputError(fmt::format("{}: cannot write", file.string()));
  }
}

// Returns gnuplot's error in one line. Its own form is a blank line, the offending input, a caret,
// and `"script", line 3: what is wrong`.
std::string complaint(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::string last;
  while (std::getline(stream, line)) {
    if (line.find(" line ") != std::string::npos) {
      return line;
    }
    if (!line.empty()) {
      last = line;
    }
  }
  return last;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "tactus-plot-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw InputError(fmt::format("{}: cannot make a temporary folder: {}", pattern,
                                 std::generic_category().message(errno)));
  }
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void write_raw_rgb(const std::filesystem::path& file, const GreyImage& image) {
  std::string bytes;
  bytes.reserve(3 * image.pixels.size());
  for (const std::uint8_t grey : image.pixels) {
    bytes.append(3, static_cast<char>(grey));
  }
  write_file(file, bytes);
}

namespace {

std::filesystem::path picture_of(const TemporaryFolder& folder) {
  return folder.path() / "picture.png";
}

// Runs gnuplot without a shell, so that no file name can be taken for a command. Throws InputError.
void draw(const TemporaryFolder& folder, std::string_view script) {
  const std::filesystem::path script_file = folder.path() / "script.gp";
  const std::filesystem::path messages = folder.path() / "messages.txt";
  write_file(script_file, script);

  std::string program = "gnuplot";
  std::string argument = script_file.string();
  const std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int failure =
      posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) {
    throw InputError("gnuplot is not installed; it is in the Debian package gnuplot-nox");
  }
  if (failure != 0) {
    throw InputError(
        fmt::format("cannot start gnuplot: {}", std::generic_category().message(failure)));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw InputError(fmt::format("gnuplot failed: {}", complaint(messages)));
  }
}

// Returns true if the bytes begin and end as a PNG file does. gnuplot does not report a full disk.
bool is_whole_png(std::string_view bytes) {
  constexpr std::string_view kHead = "\x89PNG\r\n\x1a\n";
  constexpr std::string_view kLastChunk = "IEND\xae\x42\x60\x82";
  return bytes.starts_with(kHead) && bytes.ends_with(kLastChunk);
}

}  // namespace

void run_gnuplot(const TemporaryFolder& folder, std::string_view script,
                 const std::filesystem::path& png) {
  draw(folder, script);
  const std::string picture = read_file(picture_of(folder));
  if (!is_whole_png(picture)) {
    throw InputError(fmt::format("{}: gnuplot's picture is not whole; is the disk of {} full?",
                                 png.string(), folder.path().string()));
  }
  OutputFile file(png, OutputKind::file);
  file.write(std::as_bytes(std::span(picture)));
  file.commit();
}

std::string picture_head(const TemporaryFolder& folder, double width, double height) {
  constexpr std::string_view kHead = R"gnuplot(
if (strstrt(GPVAL_TERMINALS, "pngcairo")) {{
  set terminal pngcairo size {width},{height} font "DejaVu Sans,15" linewidth 1.4 rounded background "#ffffff"
}} else {{
  set terminal png truecolor size {width},{height} font "DejaVu Sans,12"
}}
set output {output}
set multiplot
)gnuplot";
  return fmt::format(kHead, fmt::arg("width", width), fmt::arg("height", height),
                     fmt::arg("output", gnuplot_string(picture_of(folder).string())));
}

std::string gnuplot_string(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < kFirstPrintable || byte == kDelete ? ' ' : c;
    if (c == '\'') {
      result += c;
    }
  }
  return result + "'";
}

}  // namespace tactus::host
