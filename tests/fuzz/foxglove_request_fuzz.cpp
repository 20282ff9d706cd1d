// The requests of a viewer that `tactus foxglove` takes from the network, on any bytes: whatever
// comes, the client has subscriptions of channels that there are, and answers that are JSON.
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "host_tools/foxglove/client.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus {
namespace {

constexpr std::uint32_t kChannels = 3;

// Takes every turn that a client has.
void check_turns(host::FoxgloveClient& client) {
  std::array<host::FoxgloveNewest, kChannels> newest;
  for (host::FoxgloveNewest& message : newest) {
    message.number = 1;
  }
  while (const auto turn = client.take_turn(newest)) {
    fuzz::require(turn->channel >= 1 && turn->channel <= kChannels, "a channel is there");
    fuzz::require(client.wants(turn->channel), "a turn is of a subscription");
  }
}

void check_answers(host::FoxgloveClient& client) {
  while (const auto text = client.take_text()) {
    fuzz::require(nlohmann::json::accept(*text), "an answer is JSON");
  }
}

}  // namespace
}  // namespace tactus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::host::FoxgloveClient client;
  // A zero byte parts one message from the next.
  std::string bytes(data, data + size);
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\0');
    if (client.hear(bytes.substr(0, end), false, tactus::kChannels)) {
      break;
    }
    bytes.erase(0, end == std::string::npos ? end : end + 1);
    tactus::check_turns(client);
  }
  tactus::check_answers(client);
  return 0;
}
