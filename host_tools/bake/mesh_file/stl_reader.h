// Reads STL files (stereolithography), text and binary. mesh_import.h calls it.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/bake/mesh_file/polygon_mesh.h"

namespace tactus::host {

// Returns the facets of an STL file, each with vertices of its own. A facet of a text may have more
// than three vertices, and keywords may be in capitals. A binary file may begin with "solid" as a
// text does: its size then is that of the facets that it declares. Throws InputError for a file
// that ends early, a number that is not finite, and content that is neither text nor binary STL.
PolygonMesh read_stl(const std::string& file, std::string_view content);

}  // namespace tactus::host
