// The words for what a touch tells, for texts, files and screens.
#pragma once

#include <array>
#include <string_view>

#include "rendering/touch.h"

namespace tactus::rendering {

// The words of ContactKind and of FrictionState, by their values.
inline constexpr std::array<std::string_view, 4> kContactNames = {"none", "face", "edge", "vertex"};
inline constexpr std::array<std::string_view, 3> kFrictionNames = {"free", "stick", "slip"};

}  // namespace tactus::rendering
