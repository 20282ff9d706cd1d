// What goes into a recording beside its ticks, each once by its name.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace tactus::firmware {

// A file that goes into the recording whole. Name and bytes stay where they are while it is known.
struct Attachment {
  std::string_view name;
  std::span<const std::byte> bytes;
};

class AttachmentList {
 public:
  static constexpr std::size_t kMost = 8;

  // In place of one of the same name. False if there is no room.
  bool set(const Attachment& attachment) {
    const auto known = std::span(attachments_).first(count_);
    const auto place = std::ranges::find(known, attachment.name, &Attachment::name);
    if (place != known.end()) {
      *place = attachment;
      return true;
    }
    if (count_ == kMost) {
      return false;
    }
    attachments_[count_] = attachment;
    ++count_;
    return true;
  }

  [[nodiscard]] std::span<const Attachment> all() const {
    return std::span(attachments_).first(count_);
  }

 private:
  std::array<Attachment, kMost> attachments_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::firmware
