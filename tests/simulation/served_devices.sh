#!/usr/bin/env bash
# served_devices.sh TACTUS EXAMPLES: two devices that are served and recorded in one scene, which an operator changes, stop together and
# replay together to their end.
set -euo pipefail
tactus="$1" examples="$2"
work="$(mktemp -d)"
export TACTUS_RUN_DIR="$work/run"

for scene in grasp wall; do
  "$tactus" bake --quiet "$examples/$scene/scene.toml" -o "$work/$scene.tactus"
done
"$tactus" sim "$work/grasp.tactus" --device falcon --device falcon --path "$examples/grasp/thumb.csv" --path "$examples/grasp/finger.csv" \
  --serve --record "$work/run.mcap" &
served=$!
trap 'kill "$served" 2>/dev/null || true; wait; rm -rf "$work"' EXIT
for _ in {1..100}; do
  [[ -S "$work/run/2/command.sock" ]] && break
  sleep 0.05
done

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
kill -INT "$served"
wait "$served"
"$tactus" replay "$work/run.mcap" "$work/run.2.mcap" | tee "$work/replayed"
grep -q 'every hash equal' "$work/replayed"
