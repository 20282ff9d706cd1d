#!/usr/bin/env bash
# tactusd is built without libusb and libgpiod where they are not wanted or not there: it says so, and refuses the devices that need them
# with the reason. Everything else is as in build/release, from whose cache it comes.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
tests/checks/build.sh release tactus
mkdir "$work/run"
cmake --preset release -B build/without -D TACTUS_USB=OFF -D TACTUS_GPIO=OFF -D TACTUS_TESTS=OFF >"$work/configured"
cmake --build build/without --target tactusd

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
says "configuring lists what is left out" "Left out: USB: " "$work/configured"
says "configuring lists what is left out" "Left out: GPIO: " "$work/configured"
build/without/bin/tactusd --version >"$work/version"
says "tactusd tells it" "no USB (built without libusb-1.0), no GPIO (built without libgpiod 2)" "$work/version"
if ldd build/without/bin/tactusd | grep -E "libusb|libgpiod"; then
  echo "FAILS: tactusd is linked with what is left out" && failures=$((failures + 1))
fi

# refuses EXAMPLE TEXT: the device of an example cannot be opened, for this reason.
refuses() {
  build/release/bin/tactus bake "host_tools/examples/devices/$1.toml" -o "$work/device.tactus" >/dev/null
  build/release/bin/tactus bake host_tools/examples/wall/scene.toml -o "$work/scene.tactus" >/dev/null
  local code=0
  build/without/bin/tactusd "$work/device.tactus" "$work/scene.tactus" --run-dir "$work/run" --allow-non-realtime --flight-dir "$work" >"$work/output" 2>&1 || code=$?
  says "$1 is refused" "$2" "$work/output"
  [[ "$code" -ne 0 ]] || { echo "FAILS: $1 ends with 0" && failures=$((failures + 1)); }
}
refuses falcon "built without USB; install libusb-1.0 and build it anew"
refuses hapkit "built without GPIO; install libgpiod 2 and build it anew"
[[ "$failures" -eq 0 ]]
