# Three moteus servos on CAN FD touch the bunny; then the plug.
drive='moteus --nodes 1,2,3 --timeout-mode 0' device=moteus_arm
. /rig/arm_on_can.inc
