#include "host_tools/emulators/emulated_encoder.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {

EmulatedEncoder emulated_encoder(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, EmulatedEncoder>, 3> kEncoders = {{
      {"incremental", EmulatedEncoder::incremental},
      {"absolute", EmulatedEncoder::absolute},
      {"multi_turn", EmulatedEncoder::multi_turn},
  }};
  for (const auto& [known, encoder] : kEncoders) {
    if (known == name) {
      return encoder;
    }
  }
  throw InputError("no encoder '" + std::string(name) +
                   "'; there are: incremental, absolute, multi_turn");
}

double turns_forgotten(EmulatedEncoder encoder, double turns) {
  switch (encoder) {
    case EmulatedEncoder::incremental:
      return turns;
    case EmulatedEncoder::absolute:
      return std::floor(turns);
    case EmulatedEncoder::multi_turn:
      break;
  }
  return 0.0;
}

}  // namespace tactus::host
