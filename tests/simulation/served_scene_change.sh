#!/usr/bin/env bash
# served_scene_change.sh TACTUS EXAMPLES: a run that is served and recorded, whose scene an operator changes twice, replays
# to its end.
set -euo pipefail
tactus="$1" examples="$2"
# shellcheck source=tests/simulation/served.inc
source "$(dirname "${BASH_SOURCE[0]}")/served.inc"

for scene in wall ramp; do
  "$tactus" bake --quiet "$examples/$scene/scene.toml" -o "$work/$scene.tactus"
done
serve "$work/wall.tactus"

"$tactus" home --wait
for scene in ramp wall; do
  "$tactus" enable
  sleep 0.3
  "$tactus" disable
  "$tactus" scene "$work/$scene.tactus"
done
sleep 0.1
stop_serving
"$tactus" replay "$work/run.mcap" | tee "$work/replayed"
grep -q 'every hash equal' "$work/replayed"
