// The scene loader on any bytes: it refuses them or what it lets through can be touched. The header
// is made right for three inputs in four, so that the payload is reached.
#include <algorithm>
#include <array>
#include <cstring>

#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_image.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 16;

struct alignas(rendering::kCacheLine) Image {
  std::array<std::byte, sizeof(rendering::ImageHeader) + kMostBytes> bytes{};
  std::size_t size = 0;
};

Image image;

void make_image(std::span<const std::byte> input) {
  const bool right_header = (static_cast<unsigned>(input[0]) & 3U) != 0;
  const auto rest = input.subspan(1, std::min(input.size() - 1, kMostBytes));
  if (!right_header) {
    std::ranges::copy(rest, image.bytes.begin());
    image.size = rest.size();
    return;
  }
  rendering::ImageHeader header{.payload_bytes = rest.size()};
  std::ranges::copy(rest, image.bytes.begin() + sizeof(header));
  header.checksum = rendering::image_checksum(
      header, std::span(image.bytes).subspan(sizeof(header), rest.size()));
  std::memcpy(image.bytes.data(), &header, sizeof(header));
  image.size = sizeof(header) + rest.size();
}

void touch(const rendering::SceneImage& scene) {
  static rendering::World world;
  if (!world.set_scene(scene.objects(), rendering::world_of(scene))) {
    return;
  }
  for (int i = 0; i < 8; ++i) {
    const double at = 0.01 * i;
    const rendering::Touch touch =
        world.touch({.p_W = Vec3(0.02 - at, 0.03 - at, 0.05 - 2.0 * at), .v_W = Vec3::Zero()});
    fuzz::require(touch.force_W.allFinite(), "the force of a scene that was let through is finite");
  }
}

}  // namespace
}  // namespace tactus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  tactus::make_image(std::as_bytes(std::span(data, size)));
  const auto scene = tactus::rendering::SceneImage::open(
      std::span<const std::byte>(tactus::image.bytes).first(tactus::image.size));
  if (scene) {
    tactus::touch(*scene);
  }
  return 0;
}
