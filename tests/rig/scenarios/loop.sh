#!/bin/sh
# experiment
modprobe -a vcan can-raw
ip link add dev can0 type vcan && ip link set can0 mtu 72 up
stress() {
  hackbench -g 1 -f 2 -l 100000000 >/dev/null 2>&1 &
  (while :; do ls -lR /usr /lib >/dev/null; dd if=/dev/zero of=/tmp/x bs=64k count=16 2>/dev/null; done) &
}
emu='tactus emulate odrive --nodes 0,1,2 --can can0 --mechanism woodenhaptics --ratio 16,12,12 --hand pen --path /images/wish.csv --origin 0.0,-0.01,0.23 --realtime 70'
stress
for rate in 1000 2000 4000; do
  $emu --seconds 3.4 2>/results/emu.$rate &
  e=$!
  sleep 0.3
  echo "== $rate"
  tactusd /images/odrive_arm.tactus /images/bunny.tactus --enable --rate $rate --seconds 2.5 --histogram /results/h.$rate.csv --record /results/r.$rate.csv
  wait $e
  cat /results/emu.$rate
  $emu --seconds 2.9 2>/results/emuc.$rate &
  e=$!
  sleep 0.3
  cyclictest -m -q -p 80 -N --secaligned -i $((1000000/rate)) -D 2s
  wait $e
  cat /results/emuc.$rate
done
exit 0
