// Turns the pictures of an object into the textures that the controller looks up.
#pragma once

#include <string>

#include "host_tools/bake/scene/detail_description.h"
#include "host_tools/bake/scene/image_writer.h"

namespace tactus::host {

// Reads the pictures and makes their coarser levels. `has_places` is true if the mesh has texture
// coordinates; `scene` names the scene file in errors. Throws InputError that names the scene and
// its line, or the picture: a missing file, a file that is no picture, missing texture coordinates,
// a normal map without colour, or more than 1 GiB of pictures.
BakedTextures bake_textures(const DetailDescription& detail, bool has_places,
                            const std::string& scene);

}  // namespace tactus::host
