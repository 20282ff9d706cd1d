#!/usr/bin/env bash
# served_explanation.sh TACTUS EXAMPLES: a run that is served and recorded explains its ticks while somebody watches them;
# its replay has every hash and every explanation again, and its ticks before and after have none.
set -euo pipefail
tactus="$1" examples="$2"
# shellcheck source=tests/simulation/served.inc
source "$(dirname "${BASH_SOURCE[0]}")/served.inc"

"$tactus" bake --quiet "$examples/ramp/scene.toml" -o "$work/scene.tactus"
serve "$work/scene.tactus"

"$tactus" home --wait
"$tactus" enable
"$tactus" watch --explain --seconds 30 >"$work/lines" &
watching=$!
for _ in {1..250}; do
  [[ -f "$work/lines" ]] && grep -q "state=face friction=stick" "$work/lines" && break
  sleep 0.1
done
kill -TERM "$watching"
wait "$watching" || true
sleep 0.3
stop_serving

for field in 'state=face friction=stick' 'plane1_multiplier_m=' 'static_radius_m=' 'collision_ns='; do
  grep -q -- "$field" "$work/lines" || { echo "no $field in what was watched" >&2; head -n 3 "$work/lines" >&2; exit 1; }
done
"$tactus" replay "$work/run.mcap" --explain "$work/steps.csv" | tee "$work/replayed"
grep -q 'every hash equal' "$work/replayed"
grep -qE '^[0-9]+ recorded explanations: all equal$' "$work/replayed"
explained="$(sed -nE 's/^([0-9]+) recorded explanations.*/\1/p' "$work/replayed")"
ticks="$(grep -c ',tick,' "$work/steps.csv")"
# Nobody watched at the beginning and at the end.
((explained > 0 && explained < ticks))
