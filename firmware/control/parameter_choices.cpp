#include "firmware/control/parameter_choices.h"

#include "rendering/friction/registered_models.h"
#include "rendering/objects/contact_method.h"

namespace tactus::firmware {
namespace {

static_assert(rendering::kFrictionModels.size() <= 32 && rendering::kContactMethods.size() <= 32);

// Returns the name with that number; the number must be below choice_count().
std::string_view name_at(Parameter parameter, std::uint32_t number) {
  return parameter == Parameter::friction_model ? rendering::kFrictionModels[number].name
                                                : rendering::kContactMethods[number].name;
}

}  // namespace

std::uint32_t choice_count(Parameter parameter) {
  switch (parameter) {
    case Parameter::friction_model:
      return static_cast<std::uint32_t>(rendering::kFrictionModels.size());
    case Parameter::contact:
      return static_cast<std::uint32_t>(rendering::kContactMethods.size());
    default:
      return 0;
  }
}

std::string_view choice_name(Parameter parameter, double value) {
  for (std::uint32_t i = 0; i < choice_count(parameter); ++i) {
    if (value == static_cast<double>(i)) {
      return name_at(parameter, i);
    }
  }
  return {};
}

double choice_of(Parameter parameter, std::string_view name) {
  for (std::uint32_t i = 0; i < choice_count(parameter); ++i) {
    if (name == name_at(parameter, i)) {
      return i;
    }
  }
  return kNoChoice;
}

}  // namespace tactus::firmware
