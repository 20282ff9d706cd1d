#include "host_tools/bake/mapped_scene.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Closes a descriptor at the end of its scope.
class File {
 public:
  explicit File(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error) {
  throw InputError(fmt::format("{}: cannot read: {}; check the path and its permissions",
                               path.string(), std::generic_category().message(error)));
}

rendering::SceneImage open_image(const std::filesystem::path& path,
                                 std::span<const std::byte> bytes) {
  std::expected<rendering::SceneImage, rendering::SceneError> image =
      rendering::SceneImage::open(bytes);
  if (!image) {
    throw InputError(fmt::format("{}: {}", path.string(), explain(image.error())));
  }
  return *image;
}

}  // namespace

MappedScene::Mapping::Mapping(const std::filesystem::path& path) {
  const File file(path);
  struct stat status{};
  if (file.descriptor() < 0 || ::fstat(file.descriptor(), &status) != 0) {
    fail_to_read(path, errno);
  }
  if (!S_ISREG(status.st_mode)) {
    throw InputError(fmt::format("{}: is not a file; name a scene image", path.string()));
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) {
    return;
  }
  void* start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
  if (start == MAP_FAILED) {
    fail_to_read(path, errno);
  }
  bytes_ = {static_cast<const std::byte*>(start), size};
}

MappedScene::Mapping::Mapping(Mapping&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedScene::Mapping& MappedScene::Mapping::operator=(Mapping&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

MappedScene::Mapping::~Mapping() {
  if (!bytes_.empty()) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
  }
}

MappedScene::MappedScene(const std::filesystem::path& path)
    : mapping_(path), image_(open_image(path, mapping_.bytes())) {}

std::string explain(const rendering::SceneError& error) {
  std::string text;
  if (error.object != rendering::kNoObject) {
    text += fmt::format("object {}: ", error.object);
  }
  if (const std::string_view noun = rendering::place_noun(error.fault); !noun.empty()) {
    text += fmt::format("{} {}: ", noun, error.place);
  }
  return text + std::string(rendering::describe(error.fault));
}

}  // namespace tactus::host
