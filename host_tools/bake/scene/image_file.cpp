#include "host_tools/bake/scene/image_file.h"

#include <fmt/format.h>
#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <string_view>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::TextureFormat;
using rendering::TextureSize;
using Bytes = std::vector<std::uint8_t>;

// Returns the whole file. Throws InputError if it cannot be read.
Bytes bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw InputError(fmt::format("{}: cannot be read", file.string()));
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

template <std::size_t N>
bool begins_with(const Bytes& bytes, const std::array<std::uint8_t, N>& magic) {
  return bytes.size() >= N && std::equal(magic.begin(), magic.end(), bytes.begin());
}

// Throws InputError if a side is longer than the format permits.
void check_size(std::uint32_t width, std::uint32_t height) {
  if (std::max(width, height) > rendering::kMaxTextureSide) {
    throw InputError(fmt::format("the picture has {} x {} pixels; make no side longer than {}",
                                 width, height, rendering::kMaxTextureSide));
  }
}

// Returns room for all texels; the format's number is its bytes for each texel.
Bytes room_for(TextureSize size, TextureFormat format) {
  return Bytes(std::size_t{size.width} * size.height * static_cast<std::size_t>(format));
}

// Uses libpng's simplified interface, which keeps its errors in the struct instead of long jumps.
Image read_png(const Bytes& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owner(&png, &png_image_free);
  const auto check = [&](int ok) {
    if (ok == 0 || PNG_IMAGE_FAILED(png)) {
      throw InputError(fmt::format("the PNG cannot be decoded: {}", std::string_view(png.message)));
    }
  };
  check(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()));
  check_size(png.width, png.height);
  const bool colour = (png.format & PNG_FORMAT_FLAG_COLOR) != 0;
  png.format = colour ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  // 16 bits are finer steps of the same scale; without the flag libpng takes them for linear light.
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  Image image{.size = {png.width, png.height},
              .format = colour ? TextureFormat::rgb : TextureFormat::grey};
  image.texels = room_for(image.size, image.format);
  // Transparent texels are laid over black.
  const png_color black{};
  check(png_image_finish_read(&png, &black, image.texels.data(), 0, nullptr));
  return image;
}

Image read_jpeg(const Bytes& bytes) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
  const auto check = [&](int failed) {
    if (failed != 0) {
      throw InputError(
          fmt::format("the JPEG cannot be decoded: {}", tjGetErrorStr2(decoder.get())));
    }
  };
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colours = 0;
  check(tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height,
                            &subsampling, &colours));
  const TextureSize size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  check_size(size.width, size.height);
  const bool grey = colours == TJCS_GRAY;
  Image image{.size = size, .format = grey ? TextureFormat::grey : TextureFormat::rgb};
  image.texels = room_for(size, image.format);
  // TJFLAG_ACCURATEDCT: the fast transform may differ from one processor to another.
  check(tjDecompress2(decoder.get(), bytes.data(), bytes.size(), image.texels.data(), width, 0,
                      height, grey ? TJPF_GRAY : TJPF_RGB, TJFLAG_ACCURATEDCT));
  return image;
}

// Tells the format by the first bytes and not by the file's name.
Image decode(const Bytes& bytes) {
  constexpr std::array<std::uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::array<std::uint8_t, 3> kJpeg{0xff, 0xd8, 0xff};
  if (begins_with(bytes, kPng)) {
    return read_png(bytes);
  }
  if (begins_with(bytes, kJpeg)) {
    return read_jpeg(bytes);
  }
  throw InputError("neither a PNG nor a JPEG file; save the picture as one of them");
}

}  // namespace

Image read_image(const std::filesystem::path& file) {
  const Bytes bytes = bytes_of(file);
  try {
    return decode(bytes);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Image as_grey(const Image& image) {
  if (image.format == TextureFormat::grey) {
    return image;
  }
  Image grey{.size = image.size, .texels = room_for(image.size, TextureFormat::grey)};
  for (std::size_t i = 0; i < grey.texels.size(); ++i) {
    const std::uint8_t* rgb = &image.texels[3 * i];
    // Luma of ITU-R BT.601, in whole numbers so that every processor gives the same texels.
    grey.texels[i] =
        static_cast<std::uint8_t>((299U * rgb[0] + 587U * rgb[1] + 114U * rgb[2] + 500U) / 1000U);
  }
  return grey;
}

}  // namespace tactus::host
