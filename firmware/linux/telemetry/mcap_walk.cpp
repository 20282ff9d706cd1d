#include "firmware/linux/telemetry/mcap_walk.h"

#include <unistd.h>

#include <algorithm>

namespace tactus::firmware::mcap {

bool Walk::next(Found& found) {
  if (offset_ + kRecordHeaderBytes > end_) {
    return false;
  }
  const ssize_t count =
      pread(descriptor_, found.front.data(), found.front.size(), static_cast<off_t>(offset_));
  if (count < static_cast<ssize_t>(kRecordHeaderBytes)) {
    return false;
  }
  Unpacker header(std::span<const std::byte>(found.front).first(kRecordHeaderBytes));
  found.opcode = static_cast<Opcode>(header.u8());
  found.offset = offset_;
  found.length = header.u64() + kRecordHeaderBytes;
  found.front_bytes =
      std::min(static_cast<std::size_t>(count),
               static_cast<std::size_t>(std::min<std::uint64_t>(found.length, found.front.size())));
  offset_ += found.length;
  return offset_ <= end_;
}

}  // namespace tactus::firmware::mcap
