#include "host_tools/bake/scene/texture_bake.h"

#include <fmt/format.h>

#include "host_tools/bake/scene/image_file.h"
#include "host_tools/bake/scene/mip_pyramid.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::TextureProjection;
using rendering::TextureUse;

// Throws InputError with the texture's line in the scene file.
[[noreturn]] void fail(const std::string& scene, const TextureDescription& texture,
                       const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", scene, texture.line, what));
}

// Returns the picture, as grey for everything but a normal map, whose colours are a direction.
Image read_picture(const TextureDescription& texture, const std::string& scene) {
  std::error_code error;
  if (!std::filesystem::exists(texture.image, error)) {
    fail(scene, texture,
         fmt::format("there is no image file {}; correct the path, it starts from the scene file's "
                     "folder",
                     texture.image.string()));
  }
  Image image = read_image(texture.image);
  if (texture.use != TextureUse::normal) {
    return as_grey(image);
  }
  if (image.format != rendering::TextureFormat::rgb) {
    fail(scene, texture,
         fmt::format("{} is grey; a normal map has red, green and blue, write it under "
                     "texture.bump if it shows heights",
                     texture.image.string()));
  }
  return image;
}

// Returns the projection that the scene asks for, else texture coordinates if there are any.
TextureProjection projection_of(const TextureDescription& texture, bool has_places,
                                const std::string& scene) {
  if (!texture.projection) {
    return has_places ? TextureProjection::uv : TextureProjection::triplanar;
  }
  if (*texture.projection == TextureProjection::uv && !has_places) {
    fail(scene, texture,
         "the mesh has no texture coordinates, or not for every triangle; export it with them, or "
         "write projection = \"triplanar\"");
  }
  return *texture.projection;
}

}  // namespace

BakedTextures bake_textures(const DetailDescription& detail, bool has_places,
                            const std::string& scene) {
  BakedTextures baked;
  for (const TextureDescription& texture : detail.textures) {
    const TextureProjection projection = projection_of(texture, has_places, scene);
    const Image image = read_picture(texture, scene);
    const std::vector<std::uint8_t> pyramid =
        build_mip_pyramid(image.texels, image.size, image.format);
    if (baked.texels.size() + pyramid.size() > rendering::kMostTexels) {
      fail(scene, texture, "the pictures of this object take more than 1 GiB; make them smaller");
    }
    baked.layers.push_back({.use = texture.use,
                            .projection = projection,
                            .format = image.format,
                            .width = image.size.width,
                            .height = image.size.height,
                            .first_byte = static_cast<std::uint32_t>(baked.texels.size()),
                            .tile_m = texture.tile_m,
                            .low = texture.low,
                            .high = texture.high});
    baked.texels.insert(baked.texels.end(), pyramid.begin(), pyramid.end());
  }
  return baked;
}

}  // namespace tactus::host
