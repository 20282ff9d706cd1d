#!/usr/bin/env bash
# Runs the scenarios of tests/rig/scenarios in an emulated machine with Debian's real-time kernel: real CAN, USB and GPIO
# interfaces, no hardware, and a clock that counts instructions. See --help.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

scenarios() { (cd tests/rig/scenarios && ls ./*.sh | sed -e 's#^\./##' -e 's/\.sh$//'); }

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
for device in host_tools/examples/devices/*.toml; do
  "$build/bin/tactus" bake --quiet "$device" -o "$images/$(basename "$device" .toml).tactus"
done
rm -f "$images/bunny00.off"

host_tools/rig/initramfs.sh build/rig/kernel build/rig/initramfs.gz "${programs[@]}" tests/rig/scenarios:/rig \
  "$images":/images host_tools/examples/bunny/wish.csv:/images/

passed=0 failed=0
for name in "${wanted[@]}"; do
  echo "== rig: $name"
  results="build/rig/results/$name" code=0 start=$SECONDS
  read -r -a options < <(sed -n 's/^# qemu: //p' "tests/rig/scenarios/$name.sh" | paste -sd' ')
  host_tools/rig/boot.sh build/rig/kernel build/rig/initramfs.gz "$name" "$results" "${options[@]}" || code=$?
  grep -E '^(SKIPPED|measured:)' "$results/console.log" || true
  if [[ $code -eq 0 ]]; then
    passed=$((passed + 1))
    echo "rig: $name passed in $((SECONDS - start)) s"
  else
    failed=$((failed + 1))
    tail -n 100 "$results/console.log"
    echo "rig: $name FAILED after $((SECONDS - start)) s; see $results"
  fi
done
echo "rig: $passed passed, $failed failed"
if [[ -n "${TACTUS_COUNTS:-}" ]]; then
  echo "$passed $failed $(cat build/rig/results/*/console.log | grep -c '^SKIPPED' || true)" >"$TACTUS_COUNTS"
fi
[[ $failed -eq 0 ]]
