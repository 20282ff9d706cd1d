#!/usr/bin/env bash
# Shows, on a copy of the sources, that configuring fails on an include of a folder that stands above.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
source tests/checks/tracked_files.sh
tracked_files '*' | xargs -d '\n' cp --parents -t "$work"

directions="toolchains/cmake/TactusIncludeDirections.cmake"
check() { cmake "-DTACTUS_ROOT=$work" -P "$directions" >"$work/output" 2>&1; }

# expect_caught FOLDER INCLUDE: a header of FOLDER with that line does not pass.
expect_caught() {
  local offender="$work/$1/offender.h"
  echo "$2" >"$offender"
  if check || ! tr -d '\n' <"$work/output" | grep -q "$1/offender.h.*points up"; then
    echo "not caught in $1/: $2"
    cat "$work/output"
    exit 1
  fi
  rm "$offender"
  echo "caught in $1/: $2"
}

check
expect_caught firmware/safety '#include "hal/linux/image_slot.h"'
expect_caught rendering '#include "firmware/control/controller.h"'
expect_caught rendering/world '#include "../../hal/clock.h"'
expect_caught rendering '#include <tactus/drivers/device.h>'
expect_caught hal '#  include "rendering/geometry/vector.h"'
expect_caught drivers '#include "firmware/control/controller.h"'
expect_caught firmware '#include "host_tools/simulation/plant.h"'
expect_caught host_tools '#include "tests/support/random.h"'

echo '#include "firmware/control/controller.h"' >"$work/rendering/offender.h"
if cmake -S "$work" -B "$work/build" -G Ninja -DTACTUS_HOST_TOOLS=OFF >"$work/output" 2>&1; then
  echo "the configure step passed an include that points up"
  exit 1
fi
grep -A 4 "rendering/offender.h" "$work/output"
