#include "host_tools/plot/apng.h"

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::size_t kPixelBytes = 3;
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

// A frame's pixels, from the top down, red, green and blue.
struct Pixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> bytes;
};

// A rectangle of pixels; the corner is the upper left one.
struct Rectangle {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// An image of libpng's simplified interface that frees what libpng holds.
struct PngImage {
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  PngImage(PngImage&&) = delete;
  PngImage& operator=(PngImage&&) = delete;

  void check(int ok) const {
    if (ok == 0) {
      throw InputError(
          fmt::format("a frame of the animation: {}", std::string_view(image.message)));
    }
  }

  png_image image{};
};

Pixels decode(const std::string& png) {
  PngImage reader;
  reader.check(png_image_begin_read_from_memory(&reader.image, png.data(), png.size()));
  reader.image.format = PNG_FORMAT_RGB;
  Pixels pixels{.width = reader.image.width, .height = reader.image.height, .bytes = {}};
  pixels.bytes.resize(PNG_IMAGE_SIZE(reader.image));
  const png_color white{.red = 255, .green = 255, .blue = 255};
  reader.check(png_image_finish_read(&reader.image, &white, pixels.bytes.data(), 0, nullptr));
  return pixels;
}

std::string encode(const Pixels& pixels, const Rectangle& part) {
  PngImage writer;
  writer.image.width = part.width;
  writer.image.height = part.height;
  writer.image.format = PNG_FORMAT_RGB;
  const std::size_t stride = kPixelBytes * pixels.width;
  const std::uint8_t* const corner = pixels.bytes.data() + part.y * stride + kPixelBytes * part.x;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(writer.image);
  std::string bytes(size, '\0');
  writer.check(png_image_write_to_memory(&writer.image, bytes.data(), &size, 0, corner,
                                         static_cast<png_int_32>(stride), nullptr));
  bytes.resize(size);
  return bytes;
}

// Returns the smallest rectangle outside of which two frames are the same; a pixel if they are the
// same everywhere, since a frame may not be empty.
Rectangle change_of(const Pixels& before, const Pixels& now) {
  std::uint32_t left = now.width;
  std::uint32_t right = 0;
  std::uint32_t top = now.height;
  std::uint32_t bottom = 0;
  for (std::uint32_t y = 0; y < now.height; ++y) {
    for (std::uint32_t x = 0; x < now.width; ++x) {
      const auto at = static_cast<std::ptrdiff_t>(kPixelBytes * (std::size_t{y} * now.width + x));
      if (!std::equal(now.bytes.begin() + at, now.bytes.begin() + at + kPixelBytes,
                      before.bytes.begin() + at)) {
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
    }
  }
  return left > right
             ? Rectangle{.width = 1, .height = 1}
             : Rectangle{
                   .x = left, .y = top, .width = right - left + 1, .height = bottom - top + 1};
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<std::uint8_t>(bytes[at + i]);
  }
  return value;
}

// Appends a number, the most significant byte first.
void append_number(std::string& bytes, std::uint32_t value, unsigned count) {
  for (unsigned i = count; i-- > 0;) {
    bytes += static_cast<char>(value >> (8U * i) & 0xffU);
  }
}

void append_chunk(std::string& file, std::string_view type, std::string_view content) {
  append_number(file, static_cast<std::uint32_t>(content.size()), 4);
  std::string body(type);
  body += content;
  file += body;
  const auto* const bytes = reinterpret_cast<const Bytef*>(body.data());
  append_number(file, static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(body.size()))),
                4);
}

// Returns the contents of the PNG file's chunks of a type, joined. libpng wrote it: it is sound.
std::string content_of(std::string_view png, std::string_view type) {
  std::string content;
  for (std::size_t at = kPngSignature.size(); at + 12 <= png.size();) {
    const std::size_t size = word_at(png, at);
    if (png.substr(at + 4, 4) == type) {
      content += png.substr(at + 8, size);
    }
    at += size + 12;
  }
  return content;
}

// Returns the chunk that tells a frame's place and time.
std::string frame_control(std::uint32_t sequence, const Rectangle& part, double frame_s) {
  constexpr std::uint32_t kTicksInSecond = 10'000;
  const double ticks = std::round(std::clamp(frame_s, kLeastFrame_s, kMostFrame_s) *
                                  static_cast<double>(kTicksInSecond));
  std::string control;
  append_number(control, sequence, 4);
  append_number(control, part.width, 4);
  append_number(control, part.height, 4);
  append_number(control, part.x, 4);
  append_number(control, part.y, 4);
  append_number(control, static_cast<std::uint32_t>(ticks), 2);
  append_number(control, kTicksInSecond, 2);
  // The frame stays, and the next one is written over it.
  append_number(control, 0, 2);
  return control;
}

}  // namespace

std::string apng_of(std::span<const std::string> frames, double frame_s) {
  std::string file(kPngSignature);
  Pixels before;
  std::uint32_t sequence = 0;
  for (const std::string& frame : frames) {
    Pixels now = decode(frame);
    const bool is_first = before.bytes.empty();
    if (!is_first && (now.width != before.width || now.height != before.height)) {
      throw InputError("the frames of an animation must have one size");
    }
    const Rectangle part =
        is_first ? Rectangle{.width = now.width, .height = now.height} : change_of(before, now);
    const std::string png = encode(now, part);
    if (is_first) {
      append_chunk(file, "IHDR", content_of(png, "IHDR"));
      std::string control;
      append_number(control, static_cast<std::uint32_t>(frames.size()), 4);
      append_number(control, 0, 4);
      append_chunk(file, "acTL", control);
    }
    append_chunk(file, "fcTL", frame_control(sequence++, part, frame_s));
    const std::string data = content_of(png, "IDAT");
    if (is_first) {
      append_chunk(file, "IDAT", data);
    } else {
      std::string numbered;
      append_number(numbered, sequence++, 4);
      append_chunk(file, "fdAT", numbered + data);
    }
    before = std::move(now);
  }
  append_chunk(file, "IEND", "");
  return file;
}

}  // namespace tactus::host
