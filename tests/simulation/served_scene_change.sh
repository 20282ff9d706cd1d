#!/usr/bin/env bash
# served_scene_change.sh TACTUS EXAMPLES: a run that is served and recorded, whose scene an operator changes twice, replays
# to its end.
set -euo pipefail
tactus="$1" examples="$2"
work="$(mktemp -d)"
export TACTUS_RUN_DIR="$work/run"

for scene in wall ramp; do
  "$tactus" bake --quiet "$examples/$scene/scene.toml" -o "$work/$scene.tactus"
done
"$tactus" sim "$work/wall.tactus" --serve --record "$work/run.mcap" &
served=$!
trap 'kill "$served" 2>/dev/null || true; wait; rm -rf "$work"' EXIT
for _ in {1..100}; do
  [[ -S "$work/run/command.sock" ]] && break
  sleep 0.05
done

"$tactus" home --wait
for scene in ramp wall; do
  "$tactus" enable
  sleep 0.3
  "$tactus" disable
  "$tactus" scene "$work/$scene.tactus"
done
sleep 0.1
kill -INT "$served"
wait "$served"
"$tactus" replay "$work/run.mcap" | tee "$work/replayed"
grep -q 'every hash equal' "$work/replayed"
