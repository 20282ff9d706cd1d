// Makes the tables that the controller looks up from pictures.
#pragma once

#include <string>

#include "host_tools/bake/scene/detail_description.h"
#include "host_tools/bake/scene/image_writer.h"

namespace tactus::host {

// Reads the pictures and makes their coarser levels. `has_places`: the mesh has texture
// coordinates. Throws InputError naming the scene file and its line, or the picture: a file that is
// missing or no picture, texture coordinates that are not there, a normal map without colour.
BakedTextures bake_textures(const DetailDescription& detail, bool has_places,
                            const std::string& scene);

}  // namespace tactus::host
