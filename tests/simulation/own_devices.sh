#!/usr/bin/env bash
# own_devices.sh TACTUS: what tactus init arm writes bakes, is in reach of its scene, and simulates without a fault, for every mechanism
# and drive; each mechanism is certified and rehearsed, and nothing that is there is overwritten.
set -euo pipefail
tactus="$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

# A device of these answers in a folder of that name.
begin() {
  local folder="$1"
  shift
  "$tactus" init arm "$folder" --yes "$@" >/dev/null
  "$tactus" bake --quiet "$folder/device.toml" 2>"$folder/said"
  if grep -v "tactus certify\|tactus commission" "$folder/said"; then
    echo "$folder: a new device is warned of"
    exit 1
  fi
  "$tactus" bake --quiet "$folder/scene.toml"
  "$tactus" inspect "$folder/device.tactus" --scene "$folder/scene.tactus" --json >"$folder/seen" 2>/dev/null
  grep -Eq '"reached_share":(1.0|0.9[0-9]*)' "$folder/seen"
  touches "$folder" "$folder/device.toml"
}

# touches FOLDER DEVICE: the simulated hand touches the scene through the device, and no guard acts.
touches() {
  "$tactus" sim "$1/scene.tactus" --device "$2" --seconds 4 >"$1/run"
  if ! grep -q '^faults *none' "$1/run" || ! grep -q '^mode *active' "$1/run" || grep -q '^contact *0.000' "$1/run"; then
    cat "$1/run"
    exit 1
  fi
}

can="odrive_can moteus_canfd cia402_can vesc_can"
for mechanism in serial_arm delta pantograph paddle cartesian; do
  for drive in $can gpio_axis; do
    begin "$mechanism.$drive" --mechanism "$mechanism" --drive "$drive"
  done
done
begin falcon --mechanism delta --drive falcon_usb
begin haply --mechanism pantograph --drive haply_serial
begin other --lengths 0.3,0.26,0.15 --ratio 16,12,12 --counts 8192 --torque-Nm 0.2 --handle-kg 0.12 --connection can1 --rate-hz 800

# certifies DEVICE: the certificate goes into the image, and the scene is within it.
certifies() {
  "$tactus" certify "$1/device.toml" --dampings 2 >/dev/null
  "$tactus" bake --quiet "$1/device.toml" 2>/dev/null
  touches "$1" "$1/device.tactus"
  "$tactus" commission "$1/device.toml" --simulated >/dev/null 2>&1
}
for mechanism in serial_arm pantograph paddle; do
  certifies "$mechanism.odrive_can"
done
certifies other

# The Haply board of the new device, played from the other side of its line.
"$tactus" emulate haply --pty --device-file haply/device.toml --hand pen --seconds 0.3 >said
grep -q "mechanism haply/device.toml, hand pen" said

# refused WORDS ARGUMENT...: exit code 2 and those words.
refused() {
  local words="$1" code=0
  shift
  "$tactus" "$@" >said 2>&1 </dev/null || code=$?
  if [[ $code -ne 2 ]] || ! grep -qF -- "$words" said; then
    cat said
    exit 1
  fi
}
refused "falcon/device.toml: is there already and is kept" init arm falcon --yes
refused "--lengths: '0.2': write 3 lengths" init arm x --yes --lengths 0.2
refused "--drive: haply_serial turns a pantograph only" init arm x --yes --drive haply_serial
refused "--mechanism: there is no 'hexapod'" init arm x --yes --mechanism hexapod
refused "--yes takes the usual answer" init arm x
refused "these answers do not make a device: device.toml" init arm x --yes --rate-hz 5000
[[ ! -e x ]]
refused "--scene is for a device" inspect falcon/scene.tactus --scene falcon/scene.tactus
refused "this is a scene image" sim falcon/scene.tactus --device falcon/scene.tactus
refused "is no device" sim falcon/scene.tactus --device falcon/scene.toml
refused "the file of an own device" sim falcon/scene.tactus --device toaster
