#!/bin/sh
# Signals on every kind of drive while it presses: those that can be caught take the force away at once, those that cannot leave it to the
# drive's own watchdog.
# long: 230
# shellcheck source=tests/rig/scenarios/falcon_gadget.inc
. /rig/falcon_gadget.inc
modprobe -a vcan can-raw gpio-sim-oot
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
mkdir -p /run && mount -t tmpfs run /run
# shellcheck source=tests/rig/scenarios/bus_touch.inc
. /rig/bus_touch.inc
# shellcheck source=tests/rig/scenarios/signalled.inc
. /rig/signalled.inc
hang_up=1 quit=3 killed=9 stopped=19 terminal_stop=20
arm='--can can0 --mechanism woodenhaptics --ratio 16,12,12 --hand pen --origin 0.0,-0.01,0.23'
scene=bunny

# Runs `signalled`, then deletes the files that it has read: the machine's disk is small.
check() {
  signalled "$@" || exit 1
  rm -f "/results/$1.mcap" "/results/$1.truth.csv"
}

emulated="cia402 --nodes 1,2,3 --counts 65536 --path /images/wish.csv $arm" device=cia402_arm pressing_s=3
check cia402_hang_up tactusd $hang_up 0 5
check cia402_killed tactusd $killed 137 25
check cia402_stopped tactusd $stopped 137 25

emulated="moteus --nodes 1,2,3 --timeout-mode 0 --path /images/wish_later.csv $arm" device=moteus_arm pressing_s=4
check moteus_quit tactusd $quit 0 5
check moteus_killed tactusd $killed 137 25
check moteus_stopped tactusd $stopped 137 25

emulated='falcon --homed --hand pen --path /images/wish.csv --origin 0.015,-0.075,0.13' device=falcon settle_s=0.6 pressing_s=3
check falcon_terminal_stop tactusd $terminal_stop 0 5
# Its file accepts with `unproven_watchdog` that nobody knows what a Falcon does then: the emulated one keeps its force.
if signalled falcon_killed tactusd $killed 137 25; then fail 'the emulated Falcon is said to keep its force'; fi
rm -f /results/falcon_killed.mcap /results/falcon_killed.truth.csv
echo 'measured: falcon_killed: the force stays, as its device file accepts'

# shellcheck disable=SC2034  # bus_touch.inc reads it
emulated='paddle --pins encoder_a=0,encoder_b=1,direction=2,enable=3,heartbeat=4 --hand pen --path /images/wall_wish_later.csv --ratio 17.4545' device=hapkit scene=wall priority=40 joints=1 settle_s=0 pressing_s=4
check hapkit_hang_up tactusd $hang_up 0 5
check hapkit_killed tactusd $killed 137 30
check hapkit_stopped tactusd $stopped 137 30
