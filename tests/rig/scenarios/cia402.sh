#!/bin/sh
# Three CiA 402 drives on CANopen touch the bunny; then the plug.
drive='cia402 --nodes 1,2,3 --counts 65536 --encoder multi_turn' device=cia402_arm
# shellcheck source=tests/rig/scenarios/arm_on_can.inc
. /rig/arm_on_can.inc
