#include "host_tools/serial/board_images.h"

#include <fmt/format.h>

#include <algorithm>
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
constexpr std::size_t kWindowBytes = 16384;
// Bytes that have not come after this time, and that of some parts on the line, are asked for
// again; after the patience the board is given up.
constexpr hal::TimeNs kAskAgain_ns = hal::kNsPerSecond / 10;
constexpr hal::TimeNs kParts = 4;
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

// An image that comes in parts of equal size, some of which the line loses.
class Fetch {
 public:
  Fetch(BoardLink& link, BoardImage image, const ImageOnBoard& wanted)
      : link_(link),
        image_(image),
        bytes_(wanted.bytes),
        has_part_((wanted.bytes + firmware::kImagePartBytes - 1) / firmware::kImagePartBytes) {
    constexpr hal::TimeNs kPartBits = 10 * hal::TimeNs{firmware::kImagePartBytes};
    ask_again_ns_ = kAskAgain_ns + kParts * kPartBits * hal::kNsPerSecond / link.baud();
  }

  // Asks for the first bytes that are missing, if the last of those that were asked for has come or
  // nothing comes any more.
  void ask() {
    const hal::TimeNs now_ns = hal::monotonic_now_ns();
    if (is_asking_ && now_ns - asked_ns_ < ask_again_ns_) {
      return;
    }
    const auto first = std::ranges::find(has_part_, false);
    const auto end = std::find(first, has_part_.end(), true);
    const auto begin_byte =
        static_cast<std::size_t>(first - has_part_.begin()) * firmware::kImagePartBytes;
    const auto run = static_cast<std::size_t>(end - first) * firmware::kImagePartBytes;
    const std::size_t count = std::min({run, bytes_.size() - begin_byte, kWindowBytes});
    link_.send(firmware::AskImage{.image = image_,
                                  .offset = static_cast<std::uint32_t>(begin_byte),
                                  .bytes = static_cast<std::uint32_t>(count)});
    asked_end_ = begin_byte + count;
    asked_ns_ = now_ns;
    is_asking_ = true;
  }

  void take(const firmware::ImagePart& part) {
    const std::size_t number = part.offset / firmware::kImagePartBytes;
    if (part.image != image_ || part.offset % firmware::kImagePartBytes != 0 ||
        number >= has_part_.size()) {
      return;
    }
    const std::size_t size = std::min(bytes_.size() - part.offset, firmware::kImagePartBytes);
    if (part.bytes.size() != size) {
      return;
    }
    std::ranges::copy(part.bytes, bytes_.begin() + part.offset);
    came_ += has_part_[number] ? 0 : size;
    has_part_[number] = true;
    came_ns_ = asked_ns_ = hal::monotonic_now_ns();
    is_asking_ = is_asking_ && part.offset + size != asked_end_;
  }

  // Returns the number of bytes that have come.
  [[nodiscard]] std::size_t came() const { return came_; }
  [[nodiscard]] bool is_complete() const { return came_ == bytes_.size(); }
  [[nodiscard]] bool is_late() const {
    return hal::monotonic_now_ns() - came_ns_ > kFetchPatience_ns;
  }
  [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

 private:
  BoardLink& link_;
  BoardImage image_;
  std::vector<std::byte> bytes_;
  std::vector<bool> has_part_;
  std::size_t came_ = 0;
  // The end of the bytes that were asked for last, and the time of that or of the last part.
  std::size_t asked_end_ = 0;
  bool is_asking_ = false;
  hal::TimeNs asked_ns_ = 0;
  hal::TimeNs ask_again_ns_ = 0;
  hal::TimeNs came_ns_ = hal::monotonic_now_ns();
};

}  // namespace

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
    link.listen(hal::monotonic_now_ns() + kAskAgain_ns / 4, hear);
    if (progress) {
      progress(name_of_image(image), fetch.came(), wanted.bytes);
    }
    if (fetch.is_late()) {
      throw UnreachableError(
          fmt::format("{}: the board has stopped sending its {} image after {} of {} bytes; is the "
                      "rate too high for the cable?",
                      link.name(), name_of_image(image), fetch.came(), wanted.bytes));
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
