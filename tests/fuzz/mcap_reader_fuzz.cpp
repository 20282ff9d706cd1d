// The reader of recordings on any bytes: it refuses them, or what it gives lies within them. The
// magic number is made right for three inputs in four.
#include <vector>

#include "firmware/linux/telemetry/mcap_format.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/mcap_reader.h"
#include "host_tools/recording/record_decoder.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus {
namespace {

void read_all(std::span<const std::byte> file) {
  host::McapReader reader(file);
  const std::byte* const end = file.data() + file.size();
  while (const auto message = reader.next()) {
    fuzz::require(message->data.empty() || (message->data.data() >= file.data() &&
                                            message->data.data() + message->data.size() <= end),
                  "a message lies within its file");
    if (const auto tick = host::decode_tick(message->data)) {
      fuzz::require(tick->joint_count <= drivers::kMaxJoints, "no more joints than there is room");
    }
    static_cast<void>(host::decode_event(message->data));
    static_cast<void>(host::decode_explanation(message->data));
    static_cast<void>(host::decode_object_places(message->data));
    static_cast<void>(host::decode_run_info(message->data));
  }
}

}  // namespace
}  // namespace tactus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const auto input = std::as_bytes(std::span(data, size)).subspan(1);
  std::vector<std::byte> file;
  if ((data[0] & 3U) != 0) {
    const auto magic = std::as_bytes(std::span(tactus::firmware::mcap::kMagic));
    file.assign(magic.begin(), magic.end());
  }
  file.insert(file.end(), input.begin(), input.end());
  try {
    tactus::read_all(file);
  } catch (const tactus::host::InputError&) {
    return 0;
  }
  return 0;
}
