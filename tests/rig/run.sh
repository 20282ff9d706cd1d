#!/usr/bin/env bash
# Runs the scenarios of tests/rig/scenarios in an emulated machine with Debian's real-time kernel: real CAN, USB and GPIO
# interfaces, no hardware, and a clock that counts instructions. See --help.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

scenarios() { find tests/rig/scenarios -name '*.sh' -printf '%f\n' | sed 's/\.sh$//' | sort; }

usage() {
  cat <<END
usage: tests/rig/run.sh [--build FOLDER] [--help] [SCENARIO]...
  --build FOLDER   the CMake build folder to take the programs from; default build/release, which is built first
scenarios: $(scenarios | paste -sd' ')
A scenario with a line "# twice: ENDING..." runs twice, and the files with these endings must be the same; with "# soak_twice:"
it does so with TACTUS_SOAK. Those with a line "# long: SECONDS" begin first.
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
# The scenes of the scenarios are baked here: the bunny's mesh stays out of the machine.
images=build/rig/images
mkdir -p "$images"
host_tools/bunny_mesh.sh "$images/bunny00.off"
cp host_tools/examples/bunny/scene.toml "$images/bunny.toml"
"$build/bin/tactus" bake --quiet "$images/bunny.toml"
"$build/bin/tactus" bake --quiet host_tools/examples/wall/scene.toml -o "$images/wall.tactus"
cp host_tools/examples/bunny/wish.csv "$images/wish.csv"
cp host_tools/examples/wall/wish.csv "$images/wall_wish.csv"
cat >"$images/everywhere.csv" <<END
t_s,x_m,y_m,z_m
0,0,0,0
2.5,0,0,0
3,0.05,0,0
3.75,-0.05,0,0
4.25,0,0.05,0
5,0,-0.05,0
5.5,0,0,0.04
6,0,0,-0.04
6.5,0,0,0
END
for device in host_tools/examples/devices/*.toml; do
  cp "$device" "$images/"
done
# The emulated ODrives and CiA 402 drives count all turns (--encoder multi_turn): these arms need no pose to be held in. The
# emulated moteus servos do not: the hand holds the arm where its path begins, sagging by its weight, at these angles, until it has been homed.
for arm in odrive_arm cia402_arm; do
  sed -i -e 's/^driver = .*/&\nencoder = "absolute"/' -e 's/^reference = .*/reference = "absolute"/' -e '/^reference_rad/d' "$images/$arm.toml"
done
awk '/^reference_rad/ { split("-0.02275 1.23480 0.67660", angle, " "); $3 = angle[++joint] } { print }' \
  host_tools/examples/devices/moteus_arm.toml >"$images/moteus_arm.toml"
awk -F, -v OFS=, 'NR > 1 && $1 > 0 { $1 += 2 } { print }' "$images/wish.csv" >"$images/wish_later.csv"
awk -F, -v OFS=, 'NR > 1 && $1 > 0 { $1 += 2 } { print }' "$images/wall_wish.csv" >"$images/wall_wish_later.csv"
for device in "$images"/*_arm.toml "$images"/{falcon,hapkit}.toml; do
  "$build/bin/tactus" bake --quiet "$device" -o "${device%.toml}.tactus"
done
# Three arms on one bus: drives with numbers of their own, which send their positions when asked, so that there is room for all. The
# emulated drives answer once a millisecond.
for arm in 1 2 3; do
  awk -v first=$((3 * arm - 3)) '/^node_id/ { $3 += first; print; print "estimates = \"requested\"\nestimate_stale_s = 0.012\nestimate_lost_s = 0.03"; next } { print }' "$images/odrive_arm.toml" |
    sed -e "s/^rate_hz = .*/rate_hz = 160\nmax_sample_age_us = 12000/" -e '0,/^name = .*/s//&\nread_limit_s = 0.0008/' >"$images/arm_$arm.toml"
  "$build/bin/tactus" bake --quiet "$images/arm_$arm.toml" -o "$images/arm_$arm.tactus"
done
# Two Falcons, by their serial numbers.
for side in left right; do
  sed "s/^kind = \"falcon_usb\"/&\nserial = \"$side\"/" "$images/falcon.toml" >"$images/falcon_$side.toml"
  "$build/bin/tactus" bake --quiet "$images/falcon_$side.toml" -o "$images/falcon_$side.tactus"
done
# The loop that is measured does not wait long for a drive's message.
sed '0,/^name = .*/s//&\nread_limit_s = 0.00005/' "$images/odrive_arm.toml" >"$images/odrive_loop.toml"
"$build/bin/tactus" bake --quiet "$images/odrive_loop.toml" -o "$images/odrive_loop.tactus"
# Under a tracer the drives' messages come late, which is no fault there.
sed -e 's/^driver = .*/&\nestimate_stale_s = 0.1\nestimate_lost_s = 0.2/' -e '/^\[controller\]/a max_sample_age_us = 200000' \
  "$images/odrive_loop.toml" >"$images/odrive_traced.toml"
"$build/bin/tactus" bake --quiet "$images/odrive_traced.toml" -o "$images/odrive_traced.tactus"
rm -f "$images/bunny00.off"

host_tools/rig/initramfs.sh build/rig/kernel build/rig/initramfs.cpio "${programs[@]}" "$(command -v cyclictest)" "$(command -v strace)" tests/rig/scenarios:/rig "$images":/images

# Prints the words of a scenario's line "# KEY: words".
setting() { sed -n "s/^# $2: //p" "tests/rig/scenarios/$1.sh" | paste -sd' '; }

# Prints the endings of the files that a second run of the scenario must repeat, or nothing if it runs once.
repeated() {
  setting "$1" twice
  if [[ -n "${TACTUS_SOAK:-}" ]]; then setting "$1" soak_twice; fi
}

# Prints the scenario with what its line "# long: SECONDS" says before it, 0 without one.
with_length() { echo "$(setting "$1" long | grep . || echo 0) $1"; }

# One run, NAME, NAME.again or NAME.third, its verdict in results/RUN.verdict. A machine has one processor: as many run beside
# each other as this one has.
run_scenario() {
  local name="${1%%.*}" results="build/rig/results/$1" start=$SECONDS options code=0
  read -r -a options < <(setting "$name" qemu)
  host_tools/rig/boot.sh build/rig/kernel build/rig/initramfs.cpio "$name" "$results" "${options[@]}" || code=$?
  echo "$code $((SECONDS - start))" >"$results.verdict"
}

rm -f build/rig/results/*.verdict
mkdir -p build/rig/results
echo "rig: running ${wanted[*]}"
runs=()
for name in "${wanted[@]}"; do
  runs+=("$(with_length "$name")")
  if [[ -n "$(repeated "$name")" ]]; then runs+=("$(with_length "$name").again"); fi
done
# The longest begin first, so that no processor waits long for the others at the end.
mapfile -t runs < <(printf '%s\n' "${runs[@]}" | sort -s -rn | cut -d' ' -f2)
for run in "${runs[@]}"; do
  while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n; done
  run_scenario "$run" &
done
wait

# Succeeds if two runs of a scenario have left the same bytes in every file with one of its endings.
are_alike() {
  local name="${1%%.*}" ending file
  for ending in $(repeated "$name"); do
    for file in build/rig/results/"$1"/*."$ending"; do
      cmp "$file" "build/rig/results/$2/$(basename "$file")" || return 1
    done
  done
}

# On some hosts the machine's start falls in one of two ways, which moves its interrupts by some instructions: what differs
# only by that has its like in a third run.
repeats() {
  local name="$1" code
  if are_alike "$name" "$name.again"; then
    echo "measured: a second run gave the same bytes"
    return
  fi
  run_scenario "$name.third"
  read -r code _ <"build/rig/results/$name.third.verdict"
  if [[ $code -eq 0 ]] && { are_alike "$name" "$name.third" || are_alike "$name.again" "$name.third"; }; then
    echo "measured: a second run gave other bytes, a third the same as one of the two"
    return
  fi
  return 1
}

passed=0 failed=0
for name in "${wanted[@]}"; do
  console="build/rig/results/$name/console.log"
  read -r code seconds <"build/rig/results/$name.verdict"
  echo "== rig: $name"
  grep -E '^(SKIPPED|measured:)' "$console" || true
  if [[ $code -eq 0 && -n "$(repeated "$name")" ]]; then
    if ! repeats "$name"; then
      code=1
      console="build/rig/results/$name.again/console.log"
    fi
  fi
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
