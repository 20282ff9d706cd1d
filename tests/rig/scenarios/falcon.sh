#!/bin/sh
# The Falcon over USB at 1 kHz touches the bunny; then it is unplugged.
# long: 55
# shellcheck source=tests/rig/scenarios/falcon_gadget.inc
. /rig/falcon_gadget.inc
# One count of its encoders is 6.4e-4 rad.
joint_limit_rad=7e-4
emulated='falcon --homed --hand pen --path /images/wish.csv --origin 0.015,-0.075,0.13'
device=falcon scene=bunny
# shellcheck source=tests/rig/scenarios/bus_touch.inc
. /rig/bus_touch.inc
# Until the device has been enumerated.
emulate_slowly() { emulate "$@" && sleep 0.6; }

emulate_slowly touch 5.2
control touch 4
[ "$code" -eq 0 ] || fail "tactusd ended with $code"
wait "$emulator"
bus_touch_check touch /results/touch.csv /results/touch.truth.csv 3 $joint_limit_rad || exit 1

emulate_slowly unplugged 4.5 --fault all:unplugged@3
control unplugged 3.6
expect_stop unplugged 'Falcon' 3 5
