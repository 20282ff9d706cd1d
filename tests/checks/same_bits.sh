#!/usr/bin/env bash
# A simulated run gives the same state hash at every tick: twice from the optimised build, and once from what another compiler made at
# another level, under the sanitizers.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

"$here/build.sh" release tactus
"$here/build.sh" asan-ubsan tactus

devices=(cartesian falcon woodenhaptics)

# run PRESET NAME: each device on the ramp, which has faces, an edge that is met and a sheet with two sides.
run() {
  local device
  "build/$1/bin/tactus" bake host_tools/examples/ramp/scene.toml -o "$work/$2.tactus"
  for device in "${devices[@]}"; do
    "build/$1/bin/tactus" sim "$work/$2.tactus" --device "$device" --seed 7 --seconds 4 --hashes "$work/$2.$device" \
      >"$work/$2.$device.summary"
  done
}

# Equal images first, so that a difference in the baking does not pass for one in the controller.
compare() {
  local device
  cmp "$work/first.tactus" "$work/$1.tactus"
  for device in "${devices[@]}"; do
    cmp "$work/first.$device" "$work/$1.$device"
  done
}

run release first
run release second
run asan-ubsan sanitized
compare second
compare sanitized
[[ "$(wc -l <"$work/first.falcon")" -ge 4000 ]]
grep -h . "$work"/first.*.summary
