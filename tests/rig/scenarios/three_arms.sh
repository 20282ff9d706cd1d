#!/bin/sh
# Three ODrive arms, nine axes of one bus, touch the bunny under one controller; then a drive of the second arm falls silent, and all
# three lose their torque.
# long: 130
# qemu: -icount shift=0,sleep=off
mkdir -p /run # tactusd makes its folder there
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up

fail() {
  echo "FAILED: $*"
  exit 1
}

# run NAME SECONDS [OPTION]...: the controller and then the three arms, which would leave it little time to start; the options are the
# second arm's.
run() {
  name="$1" seconds="$2"
  shift 2
  tactusd /images/arm_1.tactus /images/arm_2.tactus /images/bunny.tactus /images/arm_3.tactus --enable --allow-uncommissioned \
    --seconds "$seconds" --record "/results/$name.csv" 2>"/results/$name.log" &
  controller=$!
  until grep -q 'device 3: homing' "/results/$name.log"; do
    kill -0 $controller || fail "$name: tactusd did not start: $(cat "/results/$name.log")"
    sleep 0.02
  done
  emulators=
  for arm in 1 2 3; do
    first=$((3 * arm - 3))
    options=
    [ $arm -eq 2 ] && options="$*"
    # shellcheck disable=SC2086  # they are words
    tactus emulate odrive --can can0 --nodes "$first,$((first + 1)),$((first + 2))" --encoder multi_turn --encoder-ms 0 --mechanism woodenhaptics \
      --ratio 16,12,12 --hand pen --path /images/wish_later.csv --origin 0.0,-0.01,0.23 --realtime 90 --seconds "$seconds" \
      --truth "/results/$name.$arm.truth.csv" $options 2>"/results/$name.$arm.emulator" &
    emulators="$emulators $!"
  done
  wait $controller
  code=$?
  cat "/results/$name.log"
  # shellcheck disable=SC2086
  wait $emulators
}

run touch 6
[ $code -eq 0 ] || fail "tactusd ended with $code"
bus_touch_check touch /results/touch.csv /results/touch.1.truth.csv 3 || exit 1
bus_touch_check touch /results/touch.2.csv /results/touch.2.truth.csv 3 || exit 1
bus_touch_check touch /results/touch.3.csv /results/touch.3.truth.csv 3 || exit 1

run silent 4 --fault 1:silent@3.3
[ $code -eq 1 ] || fail "silent: tactusd ended with $code"
grep -q "joint 'upper arm'" /results/silent.log || fail "silent: no joint is named"
grep -q 'arm_1.tactus is in mode fault' /results/silent.log || fail "silent: the first arm went on"
# A tick finds the drive silent; every arm has lost its torque in the same one.
bus_touch_check fault /results/silent.csv /results/silent.1.truth.csv 3 10 || exit 1
bus_touch_check fault /results/silent.2.csv /results/silent.2.truth.csv 3 10 || exit 1
bus_touch_check fault /results/silent.3.csv /results/silent.3.truth.csv 3 10 || exit 1
