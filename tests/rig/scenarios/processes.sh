#!/bin/sh
# Processes fail while three ODrive axes press the bunny. The controller is told to end, crashes beside its loop and in it, and is
# killed; the program that commands it is killed; the program that watches it stops reading.
# long: 85
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
mkdir -p /run && mount -t tmpfs run /run
emulated='odrive --nodes 0,1,2 --encoder multi_turn --can can0 --mechanism woodenhaptics --ratio 16,12,12 --hand pen --path /images/wish.csv --origin 0.0,-0.01,0.23'
device=odrive_arm scene=bunny
# shellcheck source=tests/rig/scenarios/bus_touch.inc
. /rig/bus_touch.inc

# shellcheck source=tests/rig/scenarios/signalled.inc
. /rig/signalled.inc

signalled sigterm tactusd 15 0 5 || exit 1
signalled sigsegv_in_writer telemetry 11 139 5 || exit 1
grep -q helper_crashed /results/sigsegv_in_writer.log || fail 'the fault has not been told'
signalled sigsegv_in_loop tactusd 11 139 5 || exit 1
# Nobody is left: the drives' own watchdog of 20 ms.
signalled sigkill tactusd 9 137 25 || exit 1

# Neither disturbs the loop. In real life the device has a processor of its own: here it has what the loop leaves.
# shellcheck disable=SC2034  # bus_touch.inc reads it
device=odrive_loop priority=70
start peers 4
tactus watch --run-dir /run >/results/watch.txt &
reader=$!
sleep 0.2
kill -STOP $reader
for _ in 1 2 3 4 5; do
  tactus get max_force_N --run-dir /run >/dev/null &
  sleep 0.01
  kill -KILL $!
done
answer="$(tactus get max_force_N --run-dir /run)" || fail 'the controller no longer answers'
wait "$controller"
code=$?
kill -KILL "$reader"
cat /results/peers.log
[ $code -eq 0 ] || fail "peers: tactusd ended with $code"
grep -q ' 0 missed' /results/peers.log || fail 'peers: missed ticks'
echo "measured: peers: a reader that had stopped, five commanders killed: no tick missed; then: $answer"
