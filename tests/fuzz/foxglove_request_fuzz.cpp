// The requests of a viewer that `tactus foxglove` takes from the network, on any bytes: whatever
// comes, the client has subscriptions of channels that there are, and answers that are JSON.
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "host_tools/foxglove/client.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tactus;
  constexpr std::uint32_t kChannels = 3;
  std::array<host::FoxgloveNewest, kChannels> newest;
  for (host::FoxgloveNewest& message : newest) {
    message.number = 1;
  }
  // A zero byte parts one message from the next.
  std::string bytes(data, data + size);
  host::FoxgloveClient client;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\0');
    const std::string message = bytes.substr(0, end);
    bytes.erase(0, end == std::string::npos ? end : end + 1);
    if (client.hear(message, false, kChannels)) {
      return 0;
    }
    while (const auto turn = client.take_turn(newest)) {
      fuzz::require(turn->channel >= 1 && turn->channel <= kChannels, "a channel is there");
      fuzz::require(client.wants(turn->channel), "a turn is of a subscription");
    }
  }
  while (const auto text = client.take_text()) {
    fuzz::require(nlohmann::json::accept(*text), "an answer is JSON");
  }
  return 0;
}
