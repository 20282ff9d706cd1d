#!/bin/sh
# Three ODrive axes at 1, 2 and 4 kHz beside a busy machine: no missed tick, and awake as early as cyclictest.
# twice: csv log
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
emulated='odrive --nodes 0,1,2 --encoder multi_turn --can can0 --mechanism woodenhaptics --ratio 16,12,12 --path /images/wish.csv --origin 0.0,-0.01,0.23'
device=odrive_loop priority=70
# shellcheck source=tests/rig/scenarios/loop.inc
. /rig/loop.inc

begin
loop can_1kHz bunny 1000 1
loop can_2kHz bunny 2000 0.7
# A first contact of 70,000 triangles is 0.2 ms of this machine's: too long for a period of 0.25 ms.
loop can_4kHz wall 4000 0.7
cyclic can 4000 6 bunny 2000
compare
end
