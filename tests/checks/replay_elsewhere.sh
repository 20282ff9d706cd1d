#!/usr/bin/env bash
# Runs recorded on this machine replay to the same hashes here, and on 64-bit Arm and RISC-V through qemu-user.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

"$here/build.sh" release tactus
"$here/build.sh" aarch64 replay_recording
"$here/build.sh" riscv64 replay_recording

# record SCENE DEVICE: ten seconds with a fault in them, out of which the hand finds back.
record() {
  build/release/bin/tactus bake "host_tools/examples/$1/scene.toml" -o "$work/$1.tactus"
  build/release/bin/tactus sim "$work/$1.tactus" --device "$2" --seconds 10 --fault stale@2.5x2 --record "$work/$1.$2.mcap" >"$work/summary"
}

# replay EMULATOR SYSROOT PRESET RECORDING: every tick has its hash on the other processor.
replay() {
  "$1" -L "$2" "build/$3/bin/replay_recording" "$4" | tee "$work/replayed"
  grep -q '^[0-9]\{4,\} ticks: every hash equal$' "$work/replayed"
}

for run in "ramp falcon" "ramp woodenhaptics" "membrane cartesian" "tiles cartesian" "friction cartesian" "heart cartesian"; do
  read -r scene device <<<"$run"
  record "$scene" "$device"
  echo "$scene, $device:"
  build/release/bin/tactus replay "$work/$scene.$device.mcap"
  replay qemu-aarch64-static build/sysroot/arm64 aarch64 "$work/$scene.$device.mcap"
  replay qemu-riscv64-static /usr/riscv64-linux-gnu riscv64 "$work/$scene.$device.mcap"
done

# A run on another image than it says is refused, and says which.
build/release/bin/tactus bake host_tools/examples/primitives/scene.toml -o "$work/other.tactus"
code=0
build/release/bin/tactus replay "$work/ramp.falcon.mcap" --scene "$work/other.tactus" 2>"$work/refused" || code=$?
[[ $code -eq 2 ]]
grep -q 'another image' "$work/refused"
