#include "tests/support/paths.h"

namespace tactus::testing {

std::string in_repository(std::string_view place) {
  return std::string(TACTUS_REPOSITORY "/").append(place);
}

std::string built_program(std::string_view name) {
  return std::string(TACTUS_PROGRAMS "/").append(name);
}

}  // namespace tactus::testing
