#!/usr/bin/env bash
# A tactusd without libusb and libgpiod says so, and refuses the devices that need them with the reason. It is that for RISC-V, where Debian 12
# has neither library; qemu-user runs it.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
tests/checks/build.sh release tactus
tests/checks/build.sh riscv64 tactusd
cmake --preset riscv64 >"$work/configured"
tactusd() { qemu-riscv64-static -L /usr/riscv64-linux-gnu build/riscv64/bin/tactusd "$@"; }

failures=0
# says WHAT TEXT FILE: the file has the text.
says() {
  if grep -qF -- "$2" "$3"; then
    echo "as it should be: $1"
  else
    echo "FAILS: $1: no '$2' in:"
    cat "$3"
    failures=$((failures + 1))
  fi
}
says "configuring lists USB among what is left out" "Left out: USB: " "$work/configured"
says "configuring lists GPIO, too" "Left out: GPIO: " "$work/configured"
tactusd --version >"$work/version"
says "tactusd tells it" "CAN, serial ports, no USB (built without libusb-1.0), no GPIO (built without libgpiod 2)" "$work/version"

# refuses EXAMPLE TEXT: the device of an example cannot be opened, for this reason.
mkdir "$work/run"
build/release/bin/tactus bake host_tools/examples/wall/scene.toml -o "$work/scene.tactus" >"$work/baked"
refuses() {
  build/release/bin/tactus bake "host_tools/examples/devices/$1.toml" -o "$work/device.tactus" >"$work/baked" 2>&1
  local code=0
  tactusd "$work/device.tactus" "$work/scene.tactus" --run-dir "$work/run" --allow-non-realtime --flight-dir "$work" >"$work/output" 2>&1 || code=$?
  says "the $1 is refused" "$2" "$work/output"
  [[ "$code" -eq 2 ]] || { echo "FAILS: with the $1 it ends with $code" && failures=$((failures + 1)); }
}
refuses falcon "built without USB; install libusb-1.0 and build it anew"
refuses hapkit "built without GPIO; install libgpiod 2 and build it anew"
[[ "$failures" -eq 0 ]]
