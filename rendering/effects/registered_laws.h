// The effect laws, each in a file of its own: a new law is one more #include and one more name
// here.
#pragma once

#include <array>
#include <string_view>

#include "rendering/effects/laws/constant_field.h"
#include "rendering/effects/laws/fluid_drag.h"
#include "rendering/effects/laws/magnet.h"
#include "rendering/effects/laws/snap_to_line.h"
#include "rendering/effects/laws/snap_to_plane.h"
#include "rendering/effects/laws/snap_to_point.h"
#include "rendering/effects/laws/spring.h"
#include "rendering/effects/laws/spring_damper.h"
#include "rendering/effects/laws/stick_slip.h"
#include "rendering/effects/laws/vibration.h"
#include "rendering/type_list.h"

namespace tactus::rendering {

// The first ten have tables of their own in scene.fbs, in this order. New laws go to the end.
using EffectLaws = TypeList<Spring, SpringDamper, FluidDrag, Magnet, ConstantField, Vibration,
                            StickSlip, SnapToPoint, SnapToLine, SnapToPlane>;
using EffectLaw = EffectLaws::Variant;

// The names of the laws, in that order.
inline constexpr std::array kEffectLawNames =
    EffectLaws::map([]<class Law>(std::type_identity<Law> /*law*/) { return Law::kName; });

}  // namespace tactus::rendering
