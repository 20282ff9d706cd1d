#!/bin/sh
# Three CiA 402 drives on CANopen touch the bunny; then the plug; then drives without a watchdog.
# long: 85
drive='cia402 --nodes 1,2,3 --counts 65536 --encoder multi_turn' device=cia402_arm
# shellcheck source=tests/rig/scenarios/arm_on_can.inc
. /rig/arm_on_can.inc

# A drive that does not heed the host's silence never gets torque: the bring-up finds it out.
emulate unproven 2.5 --no-watchdog
control unproven 2.2
[ "$code" -eq 1 ] || fail "unproven: tactusd ended with $code"
grep -q 'does not take the torque away' /results/unproven.log || fail "unproven: no latched fault says why"
wait "$emulator"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^shaft_._torque_Nm$/) at[i] = 1 }
  NR > 1 { for (i in at) if ($i + 0 != 0) exit 1 }' /results/unproven.truth.csv || fail "unproven: a motor had torque"
