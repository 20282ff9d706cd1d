#include "host_tools/bake/scene/image_file.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::TextureFormat;
using rendering::TextureSize;
using testing::contains;
using testing::input_error;
using testing::TemporaryFolder;

using Bytes = std::vector<std::uint8_t>;

std::string png(png_uint_32 format, TextureSize size, const void* texels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = size.width;
  image.height = size.height;
  image.format = format;
  png_alloc_size_t bytes = 0;
  png_image_write_get_memory_size(image, bytes, 0, texels, 0, nullptr);
  std::string file(bytes, '\0');
  png_image_write_to_memory(&image, file.data(), &bytes, 0, texels, 0, nullptr);
  file.resize(bytes);
  return file;
}

std::string jpeg(const Bytes& texels, int width, int height, TJPF format, TJSAMP samples) {
  const tjhandle encoder = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;  // NOLINT: the library's type
  tjCompress2(encoder, texels.data(), width, 0, height, format, &data, &size, samples, 95,
              TJFLAG_ACCURATEDCT);
  const std::string file(reinterpret_cast<const char*>(data), size);
  tjFree(data);
  tjDestroy(encoder);
  return file;
}

Bytes ramp(std::size_t count) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) {
    bytes[i] = static_cast<std::uint8_t>(i * 255 / count);
  }
  return bytes;
}

TEST(ImageFile, ReadsGreyAndColouredPngAsTheyAre) {
  const TemporaryFolder folder;
  const Bytes grey = ramp(12);
  const Image a = read_image(folder.write("a.png", png(PNG_FORMAT_GRAY, {4, 3}, grey.data())));
  EXPECT_EQ(a.format, TextureFormat::grey);
  EXPECT_EQ(a.size, (TextureSize{4, 3}));
  EXPECT_EQ(a.texels, grey);
  const Bytes colour = ramp(36);
  // Told by its content, not by its name.
  const Image b = read_image(folder.write("b.jpg", png(PNG_FORMAT_RGB, {4, 3}, colour.data())));
  EXPECT_EQ(b.format, TextureFormat::rgb);
  EXPECT_EQ(b.texels, colour);
}

TEST(ImageFile, LaysTransparencyOverBlack) {
  const TemporaryFolder folder;
  const Bytes clear{200, 100, 50, 0, 200, 100, 50, 255};
  const Image image = read_image(folder.write("a.png", png(PNG_FORMAT_RGBA, {2, 1}, clear.data())));
  EXPECT_EQ(image.texels, (Bytes{0, 0, 0, 200, 100, 50}));
}

TEST(ImageFile, ReadsJpegWithinItsLoss) {
  const TemporaryFolder folder;
  const Bytes grey = ramp(4096);
  const Image a = read_image(folder.write("a.jpg", jpeg(grey, 64, 64, TJPF_GRAY, TJSAMP_GRAY)));
  EXPECT_EQ(a.format, TextureFormat::grey);
  ASSERT_EQ(a.texels.size(), grey.size());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    ASSERT_LE(std::abs(a.texels[i] - grey[i]), 4);
  }
  const Bytes colour(768, 90);
  const Image b = read_image(folder.write("b.jpg", jpeg(colour, 16, 16, TJPF_RGB, TJSAMP_444)));
  EXPECT_EQ(b.format, TextureFormat::rgb);
  EXPECT_LE(std::abs(b.texels[100] - 90), 2);
}

TEST(ImageFile, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  const auto failure = [&](const std::string& name, const std::string& content) {
    const auto file = folder.write(name, content);
    const std::string message = input_error([&] { read_image(file); });
    EXPECT_TRUE(contains(message, name));
    return message;
  };
  EXPECT_TRUE(
      contains(input_error([&] { read_image(folder.path() / "no.png"); }), "cannot be read"));
  EXPECT_TRUE(contains(failure("text.png", "P2 4 4 255"), "neither a PNG nor a JPEG"));
  EXPECT_TRUE(contains(failure("empty.jpg", ""), "neither a PNG nor a JPEG"));
  const std::string good_png = png(PNG_FORMAT_GRAY, {64, 64}, ramp(4096).data());
  EXPECT_TRUE(contains(failure("cut.png", good_png.substr(0, good_png.size() / 2)), "decoded"));
  std::string broken = good_png;
  broken[broken.size() / 2] = static_cast<char>(broken[broken.size() / 2] ^ 0x55);
  EXPECT_TRUE(contains(failure("broken.png", broken), "decoded"));
  const std::string good_jpeg = jpeg(ramp(4096), 64, 64, TJPF_GRAY, TJSAMP_GRAY);
  EXPECT_TRUE(contains(failure("cut.jpg", good_jpeg.substr(0, good_jpeg.size() / 2)), "decoded"));
  EXPECT_TRUE(contains(failure("head.jpg", good_jpeg.substr(0, 3)), "decoded"));
  const Bytes wide(rendering::kMaxTextureSide + 1, 7);
  EXPECT_TRUE(contains(
      failure("wide.png", png(PNG_FORMAT_GRAY, {rendering::kMaxTextureSide + 1, 1}, wide.data())),
      "no side longer than"));
}

TEST(ImageFile, GreyIsTheLumaOfColour) {
  const Image colour{
      .size = {2, 1}, .format = TextureFormat::rgb, .texels = {255, 255, 255, 100, 50, 200}};
  const Image grey = as_grey(colour);
  EXPECT_EQ(grey.format, TextureFormat::grey);
  EXPECT_EQ(grey.texels, (Bytes{255, 82}));
  EXPECT_EQ(as_grey(grey).texels, grey.texels);
}

}  // namespace
}  // namespace tactus::host
