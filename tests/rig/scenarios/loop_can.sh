#!/bin/sh
# Three ODrive axes at 500 Hz and 1 kHz beside a busy machine: no missed tick, and awake as early as cyclictest. A real bus of
# 1 Mbit/s carries no faster rate for three drives, and tactusd refuses one.
# long: 130
# twice: csv log
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
emulated='odrive --nodes 0,1,2 --encoder multi_turn --can can0 --mechanism woodenhaptics --ratio 16,12,12 --path /images/wish.csv --origin 0.0,-0.01,0.23'
devices=odrive_loop priority=70
# shellcheck source=tests/rig/scenarios/loop.inc
. /rig/loop.inc

begin
loop can_500Hz bunny 500 1
loop can_1kHz bunny 1000 1
cyclic can 4000 6 bunny 1000
compare
end
