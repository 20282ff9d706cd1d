#!/usr/bin/env bash
# served_devices.sh TACTUS EXAMPLES: two devices that are served and recorded in one scene, which an operator changes, stop together and
# replay together to their end.
set -euo pipefail
tactus="$1" examples="$2"
# shellcheck source=tests/simulation/served.inc
source "$(dirname "${BASH_SOURCE[0]}")/served.inc"

for scene in grasp wall; do
  "$tactus" bake --quiet "$examples/$scene/scene.toml" -o "$work/$scene.tactus"
done
serve "$work/grasp.tactus" --device falcon --device falcon --path "$examples/grasp/thumb.csv" --path "$examples/grasp/finger.csv"
wait_for_socket "$work/run/2/command.sock"

for device in 1 2; do "$tactus" home --wait --device $device; done
for device in 1 2; do "$tactus" enable --device $device; done
sleep 0.3
for device in 1 2; do "$tactus" disable --device $device; done
"$tactus" scene "$work/wall.tactus"
if "$tactus" scene "$work/wall.tactus" --device 2; then
  echo "the second device has taken a scene"
  exit 1
fi
for device in 1 2; do "$tactus" enable --device $device; done
sleep 0.1
"$tactus" estop --device 2
"$tactus" status | tee "$work/status"
grep -q 'mode=fault faults=other_device' "$work/status"
stop_serving
"$tactus" replay "$work/run.mcap" "$work/run.2.mcap" | tee "$work/replayed"
grep -q 'every hash equal' "$work/replayed"
