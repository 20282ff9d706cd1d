// The encoders of emulated drives: how much of its position a drive knows when it gets its power.
#pragma once

#include <cstdint>
#include <string_view>

namespace tactus::host {

// The value that a drive's encoder reads when the drive gets its power.
enum class EmulatedEncoder : std::uint8_t {
  // 0, wherever the shaft stands.
  incremental,
  // The angle within a turn.
  absolute,
  // The angle with its turns: the encoder keeps counting without power.
  multi_turn,
};

// Returns the encoder of a name on the command line, such as "absolute". Throws InputError for
// another name.
EmulatedEncoder emulated_encoder(std::string_view name);

// Returns how many turns of the shaft's position the encoder does not know of when it gets its
// power at `turns`.
double turns_forgotten(EmulatedEncoder encoder, double turns);

}  // namespace tactus::host
