#include "host_tools/plot/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
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

void write_raw_rgb(const std::filesystem::path& file, const GreyImage& image) {
  std::string bytes;
  bytes.reserve(3 * image.pixels.size());
  for (const std::uint8_t grey : image.pixels) {
    bytes.append(3, static_cast<char>(grey));
  }
  write_file(file, bytes);
}

std::string rgb_item(const std::filesystem::path& file, int columns, int rows,
                     const Window& window) {
  const double dx = window.width() / columns;
  const double dy = window.height() / rows;
  return fmt::format(
      "{} binary array=({},{}) format='%uchar%uchar%uchar' origin=({:.8g},{:.8g}) dx={:.8g} "
      "dy={:.8g} with rgbimage",
      gnuplot_string(file.string()), columns, rows, window.lower.right + 0.5 * dx,
      window.lower.up + 0.5 * dy, dx, dy);
}

void write_raw_rgb(const std::filesystem::path& file, std::string_view bytes) {
  write_file(file, bytes);
}

namespace {

// Runs gnuplot without a shell, so that no file name can be taken for a command. Throws InputError.
void draw(const GnuplotFolder& folder, std::string_view script) {
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

// A format of pictures: how gnuplot writes it, and how its files begin and end.
struct FormatTraits {
  PictureFormat format;
  std::string_view extension;
  // The commands that choose the terminal, as a format of fmt. A PDF file has half the size in
  // points, so that its page is not larger than a wall.
  std::string_view terminal;
  std::string_view head;
  std::string_view tail;
};

constexpr std::string_view kPngTerminal = R"gnuplot(
if (strstrt(GPVAL_TERMINALS, "pngcairo")) {{
  set terminal pngcairo size {width},{height} font "DejaVu Sans,15" linewidth 1.4 rounded background "#ffffff"
}} else {{
  set terminal png truecolor size {width},{height} font "DejaVu Sans,12"
}}
)gnuplot";
constexpr std::string_view kSvgTerminal = R"gnuplot(
set terminal svg size {width},{height} fixed font "DejaVu Sans,15" linewidth 1.4 rounded background "#ffffff"
)gnuplot";
constexpr std::string_view kPdfTerminal = R"gnuplot(
set terminal pdfcairo size ({width}/144.0),({height}/144.0) font "DejaVu Sans,15" fontscale 0.5 linewidth 1.5 rounded background "#ffffff"
)gnuplot";

constexpr auto kFormats = std::to_array<FormatTraits>({
    {PictureFormat::png, ".png", kPngTerminal, "\x89PNG\r\n\x1a\n", "IEND\xae\x42\x60\x82"},
    {PictureFormat::svg, ".svg", kSvgTerminal, "<?xml", "</svg>"},
    {PictureFormat::pdf, ".pdf", kPdfTerminal, "%PDF-", "%%EOF"},
});

const FormatTraits& traits_of(PictureFormat format) {
  return kFormats.at(static_cast<std::size_t>(format));
}

// Returns the number of bytes of the UTF-8 character at the beginning of the text; 0 if there is
// none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) {
      return 0;
    }
  }
  return length;
}

}  // namespace

PictureFormat picture_format(const std::filesystem::path& picture) {
  std::string extension = picture.extension().string();
  for (char& c : extension) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  const auto* const found = std::ranges::find(kFormats, extension, &FormatTraits::extension);
  if (found == kFormats.end()) {
    throw InputError(
        fmt::format("{}: a picture's name ends in .png, .svg or .pdf", picture.string()));
  }
  return found->format;
}

std::string_view extension_of(PictureFormat format) {
  return traits_of(format).extension;
}

void run_gnuplot(const GnuplotFolder& folder, const PictureSize& size, std::string_view script,
                 const std::filesystem::path& picture) {
  const FormatTraits& format = traits_of(picture_format(picture));
  const std::filesystem::path drawn = folder.path() / fmt::format("picture{}", format.extension);
  std::string whole = "set encoding utf8\n";
  whole += fmt::format(fmt::runtime(format.terminal), fmt::arg("width", size.width_px),
                       fmt::arg("height", size.height_px));
  whole += fmt::format("set output {}\nset multiplot\n", gnuplot_string(drawn.string()));
  whole += script;
  whole += "\nunset multiplot\nunset output\n";
  draw(folder, whole);
  // gnuplot does not report a full disk.
  const std::string bytes = read_file(drawn);
  const std::string_view written(bytes.data(), bytes.find_last_not_of('\n') + 1);
  if (!written.starts_with(format.head) || !written.ends_with(format.tail)) {
    throw InputError(fmt::format("{}: gnuplot's picture is not whole; is the disk of {} full?",
                                 picture.string(), folder.path().string()));
  }
  OutputFile file(picture, OutputKind::file);
  file.write(std::as_bytes(std::span(bytes)));
  file.commit();
}

double round_step(double least) {
  const double needed = std::max(least, std::numeric_limits<double>::min());
  const double decade = std::pow(10.0, std::floor(std::log10(needed)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= needed) {
      return factor * decade;
    }
  }
  return 10.0 * decade;
}

std::string gnuplot_string(std::string_view text) {
  std::string result = "'";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (length == 0) {
      result += '?';
    } else if (byte < kFirstPrintable || byte == kDelete) {
      result += ' ';
    } else {
      result += text.substr(0, length);
      result += text.front() == '\'' ? "'" : "";
    }
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return result + "'";
}

}  // namespace tactus::host
