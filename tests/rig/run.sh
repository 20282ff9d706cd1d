#!/usr/bin/env bash
# Runs the scenarios of tests/rig/scenarios in an emulated machine with Debian's real-time kernel: real CAN, USB and GPIO
# interfaces, no hardware, and a clock that counts instructions. See --help.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

scenarios() { (cd tests/rig/scenarios && printf '%s\n' *.sh | sed 's/\.sh$//'); }

usage() {
  cat <<END
usage: tests/rig/run.sh [--build FOLDER] [--help] [SCENARIO]...
  --build FOLDER   the CMake build folder to take the programs from; default build/release, which is built first
scenarios: $(scenarios | paste -sd' ')
Console and results of each are kept in build/rig/results/SCENARIO. Example: tests/rig/run.sh can
END
}

build=build/release
wanted=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --build)
      build="${2:?--build needs a folder}"
      shift
      ;;
    --help) usage && exit 0 ;;
    -*) usage >&2 && exit 2 ;;
    *) wanted+=("$1") ;;
  esac
  shift
done
for name in "${wanted[@]}"; do
  if [[ ! -f "tests/rig/scenarios/$name.sh" ]]; then
    echo "tests/rig/run.sh: no scenario '$name'" >&2
    usage >&2
    exit 2
  fi
done
if [[ ${#wanted[@]} -eq 0 ]]; then mapfile -t wanted < <(scenarios); fi

[[ -f "$build/build.ninja" ]] || cmake --preset "$(basename "$build")" >/dev/null
cmake --build "$build" --target rig_programs tactus tactusd
host_tools/rig/kernel.sh build/rig/kernel
programs=("$build"/bin/tactus "$build"/bin/tactusd)
for program in "$build"/rig/*; do
  if [[ -f "$program" && -x "$program" ]]; then programs+=("$program"); fi
done
# What the scenarios touch, baked here: the bunny's mesh stays out of the machine.
images=build/rig/images
mkdir -p "$images"
host_tools/bunny_mesh.sh "$images/bunny00.off"
cp host_tools/examples/bunny/scene.toml "$images/bunny.toml"
"$build/bin/tactus" bake --quiet "$images/bunny.toml"
"$build/bin/tactus" bake --quiet host_tools/examples/wall/scene.toml -o "$images/wall.tactus"
cp host_tools/examples/bunny/wish.csv "$images/wish.csv"
cp host_tools/examples/wall/wish.csv "$images/wall_wish.csv"
for device in host_tools/examples/devices/*.toml; do
  "$build/bin/tactus" bake --quiet "$device" -o "$images/$(basename "$device" .toml).tactus"
done
rm -f "$images/bunny00.off"

host_tools/rig/initramfs.sh build/rig/kernel build/rig/initramfs.gz "${programs[@]}" tests/rig/scenarios:/rig "$images":/images

# One scenario, its verdict in results/NAME.verdict. A machine has one processor: as many run beside each other as this one has.
run_scenario() {
  local name="$1" results="build/rig/results/$1" start=$SECONDS options code=0
  read -r -a options < <(sed -n 's/^# qemu: //p' "tests/rig/scenarios/$name.sh" | paste -sd' ')
  host_tools/rig/boot.sh build/rig/kernel build/rig/initramfs.gz "$name" "$results" "${options[@]}" || code=$?
  echo "$code $((SECONDS - start))" >"$results.verdict"
}

rm -f build/rig/results/*.verdict
mkdir -p build/rig/results
echo "rig: running ${wanted[*]}"
for name in "${wanted[@]}"; do
  while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n; done
  run_scenario "$name" &
done
wait

passed=0 failed=0
for name in "${wanted[@]}"; do
  console="build/rig/results/$name/console.log"
  read -r code seconds <"build/rig/results/$name.verdict"
  echo "== rig: $name"
  grep -E '^(SKIPPED|measured:)' "$console" || true
  if [[ $code -eq 0 ]]; then
    passed=$((passed + 1))
    echo "rig: $name passed in $seconds s"
  else
    failed=$((failed + 1))
    tail -n 100 "$console"
    echo "rig: $name FAILED after $seconds s; see build/rig/results/$name"
  fi
done
echo "rig: $passed passed, $failed failed"
if [[ -n "${TACTUS_COUNTS:-}" ]]; then
  echo "$passed $failed $(cat build/rig/results/*/console.log | grep -c '^SKIPPED' || true)" >"$TACTUS_COUNTS"
fi
[[ $failed -eq 0 ]]
