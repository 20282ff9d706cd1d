#!/bin/sh
# Three ODrive axes at 1 and 2 kHz beside a busy machine: no missed tick, and awake as early as cyclictest. At 4 kHz the drives'
# emulator has too little of the one processor to answer in time.
# twice: csv log
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
emulated='odrive --nodes 0,1,2 --encoder multi_turn --can can0 --mechanism woodenhaptics --ratio 16,12,12 --path /images/wish.csv --origin 0.0,-0.01,0.23'
device=odrive_loop priority=70
# shellcheck source=tests/rig/scenarios/loop.inc
. /rig/loop.inc

begin
loop can_1kHz bunny 1000 1
loop can_2kHz bunny 2000 1
cyclic can 4000 6 bunny 2000
compare
end
