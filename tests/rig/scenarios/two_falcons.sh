#!/bin/sh
# Two Falcons on two USB ports, told apart by their serial numbers, touch the bunny under one controller at 1 kHz; then the second is
# unplugged, and both lose their torque.
# long: 100
# qemu: -icount shift=0,sleep=off
mkdir -p /run # tactusd makes its folder there
# The right one comes first on the bus, and is the controller's second device.
falcons='right left'
# shellcheck source=tests/rig/scenarios/falcon_gadget.inc
. /rig/falcon_gadget.inc

fail() {
  echo "FAILED: $*"
  exit 1
}

# emulate NAME SIDE PORT SECONDS PATH [OPTION]...
emulate() {
  name="$1" side="$2" port="$3" seconds="$4" path="$5"
  shift 5
  tactus emulate falcon --homed --hand pen --path "/images/$path.csv" --origin 0.015,-0.075,0.13 --realtime 90 --seconds "$seconds" \
    --function-fs "/dev/ffs/$side" --gadget "/sys/kernel/config/usb_gadget/$side" --controller "dummy_udc.$port" \
    --truth "/results/$name.$side.truth.csv" "$@" 2>"/results/$name.$side.emulator" &
  emulators="$emulators $!"
}

# control NAME SECONDS
control() {
  sleep 0.6 # until both have been enumerated
  tactusd /images/falcon_left.tactus /images/falcon_right.tactus /images/bunny.tactus --enable --allow-uncommissioned --seconds "$2" \
    --record "/results/$1.csv" 2>"/results/$1.log"
  code=$?
  cat "/results/$1.log"
  # shellcheck disable=SC2086
  wait $emulators
}

# The left hand begins later, so that the two paths differ.
emulators=
emulate touch right 0 5.9 wish
emulate touch left 1 5.9 wish_later
control touch 4.5
[ $code -eq 0 ] || fail "tactusd ended with $code"
bus_touch_check touch /results/touch.csv /results/touch.left.truth.csv 3 7e-4 || exit 1
bus_touch_check touch /results/touch.2.csv /results/touch.right.truth.csv 3 7e-4 || exit 1

emulators=
emulate unplugged right 0 3.5 wish --fault all:unplugged@2.7
emulate unplugged left 1 3.5 wish
control unplugged 2.6
[ $code -eq 1 ] || fail "unplugged: tactusd ended with $code"
grep -q 'falcon_left.tactus is in mode fault' /results/unplugged.log || fail "unplugged: the left one went on"
bus_touch_check fault /results/unplugged.csv /results/unplugged.left.truth.csv 3 5 || exit 1
bus_touch_check fault /results/unplugged.2.csv /results/unplugged.right.truth.csv 3 5 || exit 1
