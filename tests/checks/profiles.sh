#!/usr/bin/env bash
# A profile that there is not is refused with the names of those that there are. Runs recorded in the profile desktop replay to the same
# hashes in the profile microcontroller, and a scene for which that has no room is refused by the capacity's name.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

if cmake --preset release -B "$work/none" -D TACTUS_PROFILE=pocket >"$work/configured" 2>&1; then
  echo "profiles: TACTUS_PROFILE=pocket is taken" >&2
  exit 1
fi
tr -s ' \n' ' ' <"$work/configured" | grep -q "TACTUS_PROFILE is 'pocket', and the profiles are: desktop, board, microcontroller"

"$here/build.sh" release tactus
small=build/microcontroller
export CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=true
# At -O1 it compiles in half of the time.
cmake --preset release -B "$small" -D TACTUS_PROFILE=microcontroller -D CMAKE_CXX_FLAGS_RELEASE='-O1 -DNDEBUG'
cmake --build "$small" --target replay_recording static_sizes --parallel "$(nproc)"

# replay SCENE DEVICE: writes what the small profile says of ten seconds on an example.
replay() {
  build/release/bin/tactus bake "host_tools/examples/$1/scene.toml" -o "$work/$1.tactus"
  build/release/bin/tactus sim "$work/$1.tactus" --device "$2" --seconds 10 --record "$work/$1.mcap" >"$work/summary"
  "$small/bin/replay_recording" "$work/$1.mcap" >"$work/replayed" 2>&1 || true
  echo "$1, $2: $(tail -1 "$work/replayed")"
}

for run in "ramp falcon" "gem cartesian" "friction cartesian" "heart cartesian" "grating cartesian"; do
  read -r scene device <<<"$run"
  replay "$scene" "$device"
  grep -q '^[0-9]\{4,\} ticks: every hash equal$' "$work/replayed"
done
replay tiles cartesian
grep -q '2 tools, where 1 fits (profile microcontroller)' "$work/replayed"
