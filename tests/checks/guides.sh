#!/usr/bin/env bash
# Proves the guides "How to add" of the drives, the friction models, the effects, the primitives and the mechanisms: adds one of
# each to a copy of the tree as a reader of the guide would, builds small tests of them at -O0, and runs these. The files that are
# added are in tests/guides/.
set -euo pipefail
source tests/checks/tracked_files.sh

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
tracked_files '*' | xargs -d '\n' cp --parents -t "$work"
guides="$work/tests/guides"
rendering="$work/rendering"

# add_line LIST PATTERN LINE...: puts lines before the one that matches; there must be exactly one.
add_line() {
  local list="$1" pattern="$2"
  [[ "$(grep -c "$pattern" "$list")" == 1 ]] || { echo "guides: $list has not one line with '$pattern'" >&2 && exit 1; }
  sed -i "s|$pattern.*|$3\n&|" "$list"
}

# drivers/README.md
cp -r "$guides/drive/pivot_can" "$work/drivers/"
add_line "$work/drivers/registered_drivers.h" '^#include "drivers/vesc_can/registration.h"' '#include "drivers/pivot_can/registration.h"'
add_line "$work/drivers/registered_drivers.h" '^    kVescDriver,' '    kPivotDriver,'

# rendering/friction/README.md
cp "$guides/friction_model/hess_soom.h" "$rendering/friction/models/"
add_line "$rendering/friction/registered_models.h" '^#include "rendering/friction/models/karnopp.h"' \
  '#include "rendering/friction/models/hess_soom.h"'
sed -i 's|ElastoPlasticModel>;|ElastoPlasticModel, HessSoomModel>;|' "$rendering/friction/registered_models.h"

# rendering/effects/README.md
cp "$guides/effect/detents."* "$rendering/effects/laws/"
add_line "$rendering/effects/registered_laws.h" '^#include "rendering/effects/laws/fluid_drag.h"' \
  '#include "rendering/effects/laws/detents.h"'
sed -i 's|SnapToPlane>;|SnapToPlane, Detents>;|' "$rendering/effects/registered_laws.h"

# rendering/surface/README.md
cp "$guides/surface/puck.h" "$rendering/surface/primitives/"
add_line "$rendering/surface/registered_primitives.h" '^#include "rendering/surface/primitives/sphere.h"' \
  '#include "rendering/surface/primitives/puck.h"'
sed -i 's|TorusSolid>;|TorusSolid, PuckSolid>;|' "$rendering/surface/registered_primitives.h"

# firmware/kinematics/README.md
kinematics="$work/firmware/kinematics"
configuration="$work/firmware/configuration"
cp "$guides/mechanism/planar_arm."* "$kinematics/"
cp "$guides/mechanism/planar_arm_preset.cpp" "$configuration/"
add_line "$kinematics/registered_mechanisms.h" '^#include "firmware/kinematics/serial_arm.h"' '#include "firmware/kinematics/planar_arm.h"'
sed -i 's|SerialArm>;|SerialArm, PlanarArm>;|' "$kinematics/registered_mechanisms.h"
add_line "$configuration/controller_config.h" '^struct Preset {' 'ControllerConfig planar_arm_config();\n'
add_line "$configuration/controller_config.h" '    Preset{"woodenhaptics"' '    Preset{"planar_arm", planar_arm_config},'

echo 'add_subdirectory(tests/guides)' >>"$work/CMakeLists.txt"
cd "$work"
export CCACHE_BASEDIR="$work" CCACHE_NOHASHDIR=true
# An added file moves others to another compilation. All files of a target together show that it can do so anywhere: that no two of
# them give one name to two things.
cmake --preset debug -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DTACTUS_TESTS=OFF >configured.log || { cat configured.log && exit 1; }
cmake --build build/debug --target added_kinds_test added_drive_test --parallel "$(nproc)"
build/debug/tests/guides/added_kinds_test --gtest_brief=1
build/debug/tests/guides/added_drive_test --gtest_brief=1
