#include "host_tools/serial/board_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>
#include <utility>

#include "hal/linux/mapped_file.h"
#include "hal/linux/system.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "rendering/scene/image_format.h"

namespace tactus::host {
namespace {

using firmware::BoardImage;
using firmware::ImageOnBoard;

// The bytes that are asked for at a time: few enough for a line that loses some.
constexpr std::uint32_t kWindowBytes = 16384;
// Bytes that have not come after the first time are asked for again, and after the second the
// board is given up.
constexpr hal::TimeNs kAskAgain_ns = hal::kNsPerSecond / 2;
constexpr hal::TimeNs kFetchPatience_ns = 5 * hal::kNsPerSecond;
// A board with a larger image than that is none.
constexpr std::uint32_t kMostImageBytes = 64U << 20U;

std::string_view name_of_image(BoardImage image) {
  return image == BoardImage::device ? "device" : "scene";
}

// Returns true if the bytes are the image that the checksum in their header says.
bool is_image(std::span<const std::byte> bytes, const ImageOnBoard& wanted) {
  rendering::ImageHeader header;
  if (bytes.size() != wanted.bytes || bytes.size() < sizeof header) {
    return false;
  }
  std::memcpy(&header, bytes.data(), sizeof header);
  return header.checksum == wanted.checksum &&
         rendering::image_checksum(header, bytes.subspan(sizeof header)) == wanted.checksum;
}

// An image that comes in parts.
class Fetch {
 public:
  Fetch(BoardLink& link, BoardImage image, const ImageOnBoard& wanted)
      : link_(link), image_(image), size_(wanted.bytes) {
    bytes_.reserve(size_);
  }

  // Asks for the next bytes if those that were asked for have come, or do not come any more.
  void ask() {
    const hal::TimeNs now_ns = hal::monotonic_now_ns();
    if (bytes_.size() < asked_ && now_ns - asked_ns_ < kAskAgain_ns) {
      return;
    }
    const auto have = static_cast<std::uint32_t>(bytes_.size());
    const std::uint32_t count = std::min(size_ - have, kWindowBytes);
    link_.send(firmware::AskImage{.image = image_, .offset = have, .bytes = count});
    asked_ = have + count;
    asked_ns_ = now_ns;
  }

  // Takes a part that follows those before it.
  void take(const firmware::ImagePart& part) {
    if (part.image == image_ && part.offset == bytes_.size() &&
        part.bytes.size() <= size_ - bytes_.size() && !part.bytes.empty()) {
      bytes_.insert(bytes_.end(), part.bytes.begin(), part.bytes.end());
      came_ns_ = asked_ns_ = hal::monotonic_now_ns();
    }
  }

  [[nodiscard]] bool is_complete() const { return bytes_.size() == size_; }
  [[nodiscard]] bool is_late() const {
    return hal::monotonic_now_ns() - came_ns_ > kFetchPatience_ns;
  }
  [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

 private:
  BoardLink& link_;
  BoardImage image_;
  std::uint32_t size_;
  std::vector<std::byte> bytes_;
  // The bytes from the image's beginning that were asked for, and when.
  std::size_t asked_ = 0;
  hal::TimeNs asked_ns_ = 0;
  hal::TimeNs came_ns_ = hal::monotonic_now_ns();
};

}  // namespace

std::filesystem::path image_folder() {
  // NOLINTBEGIN(concurrency-mt-unsafe)
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  // NOLINTEND(concurrency-mt-unsafe)
  if (cache != nullptr && *cache == '/') {
    return std::filesystem::path(cache) / "tactus";
  }
  return home != nullptr && *home == '/' ? std::filesystem::path(home) / ".cache" / "tactus" : "";
}

std::filesystem::path image_file(const std::filesystem::path& folder, BoardImage image,
                                 std::uint64_t checksum) {
  return folder / fmt::format("{}-{:016x}.tactus", name_of_image(image), checksum);
}

bool is_image_file(const std::filesystem::path& file, const ImageOnBoard& wanted) {
  hal::MappedFile mapped;
  return mapped.open(file.c_str()) == 0 && is_image(mapped.bytes(), wanted);
}

void check_user_image(const std::string& file, const ImageOnBoard& wanted) {
  const std::string content = read_file(file);
  const std::uint64_t checksum = rendering::header_checksum(std::as_bytes(std::span(content)));
  if (checksum != wanted.checksum || !is_image_file(file, wanted)) {
    throw InputError(fmt::format(
        "{}: another image than the board's: its checksum is {:016x}, and the board works with "
        "{:016x}; leave the option out, and the image comes over the line",
        file, checksum, wanted.checksum));
  }
}

std::vector<std::byte> fetch_image(BoardLink& link, BoardImage image, const ImageOnBoard& wanted,
                                   const BoardLink::Hear& other, const ShowProgress& progress) {
  if (wanted.bytes == 0 || wanted.bytes > kMostImageBytes) {
    throw UnreachableError(
        fmt::format("{}: the board says that its {} image has {} bytes; write "
                    "its program anew",
                    link.name(), name_of_image(image), wanted.bytes));
  }
  Fetch fetch(link, image, wanted);
  const auto hear = [&](std::span<const std::byte> message) {
    firmware::ImagePart part;
    if (firmware::read_message(message, part)) {
      fetch.take(part);
    } else {
      other(message);
    }
  };
  while (!fetch.is_complete()) {
    fetch.ask();
    link.listen(hal::monotonic_now_ns() + kAskAgain_ns / 10, hear);
    if (progress) {
      progress(name_of_image(image), fetch.bytes().size(), wanted.bytes);
    }
    if (fetch.is_late()) {
      throw UnreachableError(
          fmt::format("{}: the board has stopped sending its {} image at byte {} of {}; is the "
                      "rate too high for the cable?",
                      link.name(), name_of_image(image), fetch.bytes().size(), wanted.bytes));
    }
  }
  if (!is_image(fetch.bytes(), wanted)) {
    throw UnreachableError(
        fmt::format("{}: the board's {} image has changed bits; write its "
                    "program anew",
                    link.name(), name_of_image(image)));
  }
  return std::move(fetch.bytes());
}

}  // namespace tactus::host
