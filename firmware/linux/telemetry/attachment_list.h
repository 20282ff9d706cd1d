// The attachments of a recording; each name occurs once. One thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace tactus::firmware {

// A file that is stored whole in the recording. `name` and `bytes` must outlive the list.
struct Attachment {
  // The name in the recording, and the content.
  std::string_view name;
  std::span<const std::byte> bytes;
};

// The list. It keeps views, not bytes.
class AttachmentList {
 public:
  // The largest number of attachments.
  static constexpr std::size_t kMost = 8;

  // Adds an attachment or replaces the one with the same name. Returns false if the list is full.
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

  // Returns the attachments in the order in which their names were added.
  [[nodiscard]] std::span<const Attachment> all() const {
    return std::span(attachments_).first(count_);
  }

 private:
  std::array<Attachment, kMost> attachments_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::firmware
