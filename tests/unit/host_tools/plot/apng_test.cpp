#include "host_tools/plot/apng.h"

#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host_tools/input_error.h"
#include "tests/support/apng_reader.h"

namespace tactus::host {
namespace {

using testing::png_chunks;
using testing::png_number;
using testing::PngChunk;

constexpr std::uint32_t kApngWidth = 40;
constexpr std::uint32_t kApngHeight = 30;

using Picture = std::vector<std::uint8_t>;

// A white picture with a square of 4 by 4 pixels.
Picture picture_with_square(std::uint32_t x, std::uint32_t y) {
  Picture picture(std::size_t{3} * kApngWidth * kApngHeight, 255);
  for (std::uint32_t row = y; row < y + 4; ++row) {
    for (std::uint32_t column = x; column < x + 4; ++column) {
      picture[std::size_t{3} * (row * kApngWidth + column) + 1] = 0;
    }
  }
  return picture;
}

std::string png_of(const Picture& picture, std::uint32_t width, std::uint32_t height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.data(), 0, nullptr),
            0);
  bytes.resize(size);
  return bytes;
}

// Makes a PNG file of one frame's data and decodes it.
Picture decoded(std::string head, std::uint32_t width, std::uint32_t height,
                const std::string& data) {
  const auto append = [](std::string& bytes, std::uint32_t value) {
    for (const std::uint32_t shift : {24U, 16U, 8U, 0U}) {
      bytes += static_cast<char>(value >> shift & 0xffU);
    }
  };
  std::string size;
  append(size, width);
  append(size, height);
  head.replace(0, 8, size);
  std::string file = "\x89PNG\r\n\x1a\n";
  for (const auto& [type, content] :
       {std::pair<std::string, std::string>{"IHDR", head}, {"IDAT", data}, {"IEND", ""}}) {
    append(file, static_cast<std::uint32_t>(content.size()));
    file += type + content;
    append(file, testing::png_checksum(type + content));
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, file.data(), file.size()), 0);
  image.format = PNG_FORMAT_RGB;
  Picture picture(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, picture.data(), 0, nullptr), 0);
  return picture;
}

// Plays the animation as a viewer does, each frame over the one before.
std::vector<Picture> played(const std::string& file) {
  std::vector<Picture> shown;
  std::string head;
  std::string control;
  Picture canvas(std::size_t{3} * kApngWidth * kApngHeight, 0);
  for (const PngChunk& chunk : png_chunks(file)) {
    if (chunk.type == "IHDR") {
      head = chunk.content;
    } else if (chunk.type == "fcTL") {
      control = chunk.content;
    } else if (chunk.type == "IDAT" || chunk.type == "fdAT") {
      const std::uint32_t width = png_number(control, 4);
      const std::uint32_t height = png_number(control, 8);
      const Picture part = decoded(head, width, height,
                                   chunk.type == "IDAT" ? chunk.content : chunk.content.substr(4));
      for (std::size_t row = 0; row < height; ++row) {
        const std::size_t to =
            3 * ((png_number(control, 16) + row) * kApngWidth + png_number(control, 12));
        std::copy_n(part.begin() + static_cast<std::ptrdiff_t>(3 * row * width),
                    std::size_t{3} * width, canvas.begin() + static_cast<std::ptrdiff_t>(to));
      }
      shown.push_back(canvas);
    }
  }
  return shown;
}

std::vector<Picture> moving_square() {
  return {picture_with_square(2, 3), picture_with_square(5, 3), picture_with_square(5, 3),
          picture_with_square(36, 26)};
}

std::vector<std::string> png_files(const std::vector<Picture>& pictures) {
  std::vector<std::string> files;
  files.reserve(pictures.size());
  for (const Picture& picture : pictures) {
    files.push_back(png_of(picture, kApngWidth, kApngHeight));
  }
  return files;
}

TEST(Apng, AViewerShowsEveryFrameAsItWas) {
  const std::vector<Picture> pictures = moving_square();
  EXPECT_EQ(played(apng_of(png_files(pictures), 0.05)), pictures);
}

TEST(Apng, TheChunksAreInOrderWithRightChecksums) {
  const std::vector<PngChunk> chunks = png_chunks(apng_of(png_files(moving_square()), 0.05));
  std::string types;
  std::uint32_t sequence = 0;
  for (const PngChunk& chunk : chunks) {
    EXPECT_TRUE(chunk.is_sound) << chunk.type;
    types += chunk.type + " ";
    if (chunk.type == "fcTL" || chunk.type == "fdAT") {
      EXPECT_EQ(png_number(chunk.content, 0), sequence++);
    }
    if (chunk.type == "acTL") {
      EXPECT_EQ(png_number(chunk.content, 0), 4U);
      EXPECT_EQ(png_number(chunk.content, 4), 0U);
    }
    if (chunk.type == "fcTL") {
      EXPECT_DOUBLE_EQ(static_cast<double>(png_number(chunk.content, 20, 2)) /
                           static_cast<double>(png_number(chunk.content, 22, 2)),
                       0.05);
    }
  }
  EXPECT_EQ(types, "IHDR acTL fcTL IDAT fcTL fdAT fcTL fdAT fcTL fdAT IEND ");
}

TEST(Apng, OnlyTheRectangleThatChangesIsStored) {
  for (const PngChunk& chunk : png_chunks(apng_of(png_files(moving_square()), 0.05))) {
    if (chunk.type == "fcTL" && png_number(chunk.content, 0) == 1) {
      EXPECT_EQ(png_number(chunk.content, 4), 7U);   // width
      EXPECT_EQ(png_number(chunk.content, 8), 4U);   // height
      EXPECT_EQ(png_number(chunk.content, 12), 2U);  // x
      EXPECT_EQ(png_number(chunk.content, 16), 3U);  // y
    }
  }
}

TEST(Apng, FramesOfTwoSizesAndOtherFilesAreRefused) {
  std::vector<std::string> files = png_files(moving_square());
  files.push_back(png_of(Picture(300, 0), 10, 10));
  EXPECT_THROW(static_cast<void>(apng_of(files, 0.05)), InputError);
  const std::array<std::string, 1> text{"no picture"};
  EXPECT_THROW(static_cast<void>(apng_of(text, 0.05)), InputError);
}

}  // namespace
}  // namespace tactus::host
