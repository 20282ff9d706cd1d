#!/bin/sh
# tactus commission on a Falcon over USB and on an ODrive arm over CAN, through real kernel interfaces: as they should be, and
# with one motor reversed.
# long: 300
# shellcheck source=tests/rig/scenarios/falcon_gadget.inc
. /rig/falcon_gadget.inc
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up

fail() {
  echo "FAILED: $*"
  exit 1
}

# The hand holds the middle, moves the handle everywhere from 2.5 s on, and lets go at 7.5 s.
commission() { # NAME DEVICE EXPECTED_CODE EMULATED_WORDS...
  name="$1" device="$2" expected="$3"
  shift 3
  tactus emulate "$@" --hand firm --path /images/everywhere.csv --let-go 7.5 --balanced --realtime 90 --seconds 60 2>"/results/$name.emulator" &
  emulator=$!
  sleep 0.8
  cp "/images/$device.toml" "/results/$name.toml"
  tactus commission "/results/$name.toml" --unattended --travel-s 8.5 >"/results/$name.txt" 2>"/results/$name.log"
  code=$?
  kill "$emulator" && wait "$emulator"
  cat "/results/$name.log" "/results/$name.txt"
  [ "$code" -eq "$expected" ] || fail "$name: commission ended with $code"
}

commission falcon falcon 0 falcon --homed --origin 0,0,0.12
commission falcon_reversed falcon 1 falcon --homed --origin 0,0,0.12 --motor-direction 1,-1,1
grep -q 'FAILED: moves against its effort' /results/falcon_reversed.txt || fail "the reversed motor was not named"
arm='odrive --nodes 0,1,2 --encoder multi_turn --can can0 --mechanism woodenhaptics --ratio 16,12,12'
# shellcheck disable=SC2086  # they are words
commission arm odrive_arm 0 $arm
# shellcheck disable=SC2086
commission arm_reversed odrive_arm 1 $arm --motor-direction 1,1,-1
grep -q 'FAILED: moves against its effort' /results/arm_reversed.txt || fail "the reversed motor was not named"
