#!/usr/bin/env bash
# Adds a drive to a copy of the sources as "Add a device" in drivers/README.md says, one folder and its lines in one list, and
# builds and runs its test. What is added is in tests/guides/drive/.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
source tests/checks/tracked_files.sh
tracked_files '*' | xargs -d '\n' cp --parents -t "$work"

# The guide's steps.
cp -r tests/guides/drive/pivot_can "$work/drivers/"
sed -i -e 's|^#include "drivers/vesc_can/registration.h"|#include "drivers/pivot_can/registration.h"\n&|' \
  -e 's|^    kVescDriver,.*|&\n    kPivotDriver,|' "$work/drivers/registered_drivers.h"

# Its test.
cat >>"$work/tests/CMakeLists.txt" <<'END'
tactus_test(added_drive_test
  SOURCES guides/drive/pivot_can_test.cpp
  DEPENDS tactus::host_bake tactus::hal_simulated)
END

cd "$work"
git diff --no-index --stat "$OLDPWD/drivers" drivers || true
# Objects of this checkout that the drive leaves alone are taken from the compiler's cache.
export CCACHE_BASEDIR="$work" CCACHE_NOHASHDIR=true
cmake --preset release >configured.log || { cat configured.log && exit 1; }
cmake --build build/release --target added_drive_test --parallel "$(nproc)"
build/release/tests/added_drive_test --gtest_brief=1
