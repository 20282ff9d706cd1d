#!/usr/bin/env bash
# Ordinary touching is no alarm: every example scene, on every preset, in every hand, and none of the guards that look for a
# wrong motor says a word. TACTUS_PROPERTY_TICKS is the number of ticks in all.
# usage: false_alarms.sh TACTUS EXAMPLES
set -euo pipefail
tactus="$1" examples="$2"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

presets=(cartesian falcon hapkit haply_pantograph phantom_premium woodenhaptics)
hands=(finger pen firm)
# One hand is enough if a sanitizer or an emulation makes the ticks slow.
if [[ "${TACTUS_PROPERTY_TICKS:-1000000}" -lt 100000 ]]; then hands=(pen); fi
scenes=()
for scene in "$examples"/*/scene.toml; do
  name="$(basename "$(dirname "$scene")")"
  # The mesh of one example is fetched when it is wanted.
  if "$tactus" bake --quiet "$scene" -o "$folder/$name.tactus" 2>/dev/null; then scenes+=("$name"); fi
done

runs=$((${#scenes[@]} * ${#presets[@]} * ${#hands[@]}))
seconds=$(($(printf '%.0f' "${TACTUS_PROPERTY_TICKS:-1000000}") / runs / 1000))
if [[ $seconds -lt 2 ]]; then seconds=2; fi
run() {
  "$1" sim "$2/$3.tactus" --device "$4" --hand "$5" --seed "$6" --seconds "$7" --json |
    sed "s/.*\"ticks\":\([0-9]*\).*\"faults\":\[\([^]]*\)\].*/\1 $3 $4 $5 seed $6: \2/"
}
export -f run
seed=0
for scene in "${scenes[@]}"; do
  for preset in "${presets[@]}"; do
    for hand in "${hands[@]}"; do
      echo "$tactus" "$folder" "$scene" "$preset" "$hand" $((++seed)) "$seconds"
    done
  done
done | xargs -P "$(nproc)" -L 1 bash -c 'run "$@"' _ >"$folder/results"

ticks="$(awk '{ ticks += $1 } END { print ticks }' "$folder/results")"
alarms="$(grep -cE 'motor_reversed|effort_mismatch' "$folder/results" || true)"
echo "$(wc -l <"$folder/results") runs, $ticks ticks, $alarms false alarms"
grep -E 'motor_reversed|effort_mismatch' "$folder/results" || true
[[ $alarms -eq 0 && "$(wc -l <"$folder/results")" -eq $runs && ${#scenes[@]} -ge 10 ]]
