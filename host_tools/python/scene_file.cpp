#include "host_tools/python/scene_file.h"

#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host::python {

SceneFile::SceneFile(std::vector<std::byte> bytes)
    : name_("the scene in memory"), bytes_(std::move(bytes)) {
  const auto opened = rendering::SceneImage::open(bytes_);
  if (!opened) {
    throw InputError(name_ + ": " + explain(opened.error()));
  }
  image_ = *opened;
}

}  // namespace tactus::host::python
