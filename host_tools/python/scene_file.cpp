#include "host_tools/python/scene_file.h"

#include <span>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host::python {
namespace {

constexpr const char* kSceneInMemory = "the scene in memory";

rendering::SceneImage open_in_memory(std::span<const std::byte> bytes) {
  const auto opened = rendering::SceneImage::open(bytes);
  if (!opened) {
    throw InputError(std::string(kSceneInMemory) + ": " + explain(opened.error()));
  }
  return *opened;
}

}  // namespace

SceneFile::SceneFile(std::vector<std::byte> bytes)
    : name_(kSceneInMemory), bytes_(std::move(bytes)), image_(open_in_memory(bytes_)) {}

}  // namespace tactus::host::python
