#include "firmware/linux/tactusd/image_kind.h"

#include <unistd.h>

#include <array>
#include <cstddef>

#include "hal/linux/image_slot.h"
#include "rendering/scene/image_format.h"

namespace tactus::firmware {

bool is_scene_image(const char* path) {
  hal::FileDescriptor file;
  std::size_t size = 0;
  if (hal::open_regular_file(path, file, size).is_error()) {
    return false;
  }
  std::array<char, rendering::kImageMagic.size()> magic{};
  return ::pread(file.get(), magic.data(), magic.size(), 0) == static_cast<ssize_t>(magic.size()) &&
         magic == rendering::kImageMagic;
}

}  // namespace tactus::firmware
