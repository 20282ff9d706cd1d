#!/usr/bin/env bash
# rate_of_a_certificate.sh TACTUS TACTUSD EXAMPLES: tactusd refuses a certified device at a slower rate, the scenes of a
# magnet and a drag that are beyond the certificate, and walls that are so together. The Hapkit has no board here, so a run
# that passes the check ends at its connection.
set -euo pipefail
tactus="$1" tactusd="$2" examples="$3"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

mkdir "$work/run"
cp "$examples/devices/hapkit.toml" "$work/device.toml"
"$tactus" certify "$work/device.toml" >"$work/certified"
"$tactus" bake --quiet "$work/device.toml" -o "$work/device.tactus"

# run WORDS OPTION...: true when the daemon's words contain WORDS.
run() {
  local words="$1"
  shift
  "$tactusd" "$work/device.tactus" --run-dir "$work/run" --seconds 0.1 "$@" >"$work/said" 2>&1 || true
  cat "$work/said"
  grep -qF -- "$words" "$work/said"
}
passes() { ! run "certified" "$@"; }

run "certified at 1000 Hz, and --rate 250 is slower" --rate 250
passes --rate 250 --allow-uncertified
passes --rate 1000
passes --rate 2000

# A rate that baking would refuse is refused here too: the bus cannot carry it, or a drive has its own period.
# refuses DEVICE RATE WORDS
refuses() {
  "$tactus" bake --quiet "$examples/devices/$1.toml" -o "$work/other.tactus"
  local code=0
  "$tactusd" "$work/other.tactus" --run-dir "$work/run" --rate "$2" --seconds 0.1 >"$work/said" 2>&1 || code=$?
  cat "$work/said"
  [[ $code -eq 2 ]] && grep -qF -- "$3" "$work/said"
}
refuses odrive_arm 2000 "--rate 2000: 'drive 0': estimates come every 0.001 s"
refuses moteus_arm 2000 "--rate 2000: 'bus': the bus would be 175 % full"
refuses cia402_arm 500 "period_s is 0.001 s"

effect() {
  cat >"$work/effect.toml" <<END
[tool]
radius_m = 0.002
[[object]]
primitive = "box"
size_m = [0.02, 0.1, 0.1]
position_m = [0.115, 0.0, 0.0]
stiffness_N_per_m = 100.0
[[effect]]
max_force_N = 8
$1
END
  "$tactus" bake --quiet "$work/effect.toml" -o "$work/effect.tactus"
}
effect $'law = "magnet"\nstrength_N = 2.0\ncore_m = 0.0002'
run "effect 1 has a stiffness of 25980.8 N/m" "$work/effect.tactus"
effect $'law = "magnet"\nstrength_N = 2.0\ncore_m = 0.02'
passes "$work/effect.tactus"
effect $'law = "fluid_drag"\nprimitive = "box"\nsize_m = [0.2, 0.2, 0.2]\ndamping_Ns_per_m = 500.0\nrim_m = 0.001'
run "effect 1 has a damping of 500 N s/m" "$work/effect.tactus"

# walls CONTACT X1 X2: two walls of 200 N/m at those places along x; the Hapkit holds 341 N/m.
walls() {
  cat >"$work/walls.toml" <<END
[tool]
radius_m = 0.002
[[object]]
name = "wall"
primitive = "box"
size_m = [0.02, 0.1, 0.1]
position_m = [$2, 0.0, 0.0]
contact = "$1"
stiffness_N_per_m = 200.0
[[object]]
name = "wall2"
primitive = "box"
size_m = [0.02, 0.1, 0.1]
position_m = [$3, 0.0, 0.0]
contact = "$1"
stiffness_N_per_m = 200.0
END
  "$tactus" bake --quiet "$work/walls.toml" -o "$work/walls.tactus"
}
for contact in sphere_proxy potential_field; do
  walls "$contact" 0.015 0.015
  run "object 'wall' and object 'wall2' are felt in one place and together have a stiffness of 400 N/m" \
    "$work/walls.tactus"
  passes --allow-uncertified "$work/walls.tactus"
  walls "$contact" 0.015 -0.055
  passes "$work/walls.tactus"
done
walls sphere_proxy 0.015 0.035
passes "$work/walls.tactus"
