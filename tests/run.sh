#!/usr/bin/env bash
# Builds the repository and runs its tests, in a fresh clone on Debian 12; with --all, everything that it promises. See --help.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# A stage is a name and the script of tests/checks/ with its arguments.
stages=(
  "release           build_and_test.sh release"
  "links             links.sh"
  "format            format.sh"
)
all_stages=(
  "asan-ubsan        build_and_test.sh asan-ubsan test_programs"
  "tsan              threads.sh"
  "aarch64           build_and_test.sh aarch64 test_programs replay_recording tactusd"
  "armhf-core        build_and_test.sh armhf-quick hal_tests drivers_tests firmware_tests replay_tests"
  "riscv64           build_and_test.sh riscv64 hal_tests drivers_tests firmware_tests rendering_tests replay_tests"
  "cortex-m7         build.sh cortex-m7"
  "m7-image          m7_image.sh"
  "m7-line           m7_line.sh"
  "fuzz              fuzz.sh"
  "rig               rig.sh"
  "same-bits         same_bits.sh"
  "replay-elsewhere  replay_elsewhere.sh"
  "heap-check        heap_check_catches_offences.sh"
  "stack-check       stack_bound_is_right.sh"
  "include-check     include_check_catches_offences.sh"
  "tidy-check        tidy_catches_offences.sh"
  "left-out          without_usb_and_gpio.sh"
  "guides            guides.sh"
  "mutations         mutations.sh"
  "profiles          profiles.sh"
  "install           install_package.sh"
  "packages          debian_packages.sh"
  "packages-list     packages_come_from_one_list.sh"
  "shell             shell.sh"
  "tidy              tidy.sh"
)
soak_stages=(
  "alone             build.sh alone"
  "aarch64-tools     linux_board.sh aarch64 arm64 qemu-aarch64-static all"
  "packages-arm64    debian_packages.sh arm64"
  "packages-armhf    debian_packages.sh armhf"
  "armhf             linux_board.sh armhf-quick armhf qemu-arm-static tactus tactusd rendering_tests"
)
known_stages=("${stages[@]}" "${all_stages[@]}" "${soak_stages[@]}")

usage() {
  cat <<END
usage: tests/run.sh [--all] [--only STAGE]... [--soak] [--help]
Without options: every test once, optimised, and the checks of links and format.
  --all          the sanitizers, Arm, RISC-V, bare metal, fuzzing, the emulated machine, planted faults, clang-tidy, ... as well
  --only STAGE   run this stage only; may be repeated
  --soak         all of that, with random tests a hundred times as long, the loop a minute for each rate and device, and
                 $(printf '%s\n' "${soak_stages[@]}" | awk '{print $1}' | paste -sd' ')
stages: $(printf '%s\n' "${known_stages[@]}" | awk '{print $1}' | paste -sd' ')
Examples:
  tests/run.sh
  tests/run.sh --only release --only rig
Each stage's whole output is kept in build/test-logs/STAGE.log.
END
}

only=()
all=
while [[ $# -gt 0 ]]; do
  case "$1" in
    --only)
      only+=("${2:?--only needs the name of a stage}")
      shift
      ;;
    --all) all=1 ;;
    --soak) export TACTUS_SOAK=1 ;;
    --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
  esac
  shift
done
if [[ -n "$all" || -n "${TACTUS_SOAK:-}" || ${#only[@]} -gt 0 ]]; then stages+=("${all_stages[@]}"); fi
if [[ -n "${TACTUS_SOAK:-}" || ${#only[@]} -gt 0 ]]; then stages+=("${soak_stages[@]}"); fi
for name in "${only[@]}"; do
  if ! printf '%s\n' "${known_stages[@]}" | grep -q "^$name "; then
    echo "tests/run.sh: no stage '$name'" >&2
    usage >&2
    exit 2
  fi
done
is_wanted() { [[ ${#only[@]} -eq 0 || " ${only[*]} " == *" $1 "* ]]; }

logs=build/test-logs
mkdir -p "$logs"
summary=()
passed=0 failed=0 skipped=0

# Sets cpu_s to the processor time that the stages so far have taken, s. A subshell would count its own.
count_cpu() {
  times >"$logs/times"
  cpu_s="$(awk 'NR == 2 { gsub(/s/, ""); for (i = 1; i <= 2; ++i) { split($i, time, "m"); sum += 60 * time[1] + time[2] } print int(sum) }' "$logs/times")"
}

# A script that runs many tests writes "passed failed skipped" to $TACTUS_COUNTS; any other counts as one test.
run_stage() {
  local name="$1" script="$2" log="$logs/$1.log" start=$SECONDS result=pass p=1 f=0 s=0 cpu_before_s
  count_cpu && cpu_before_s=$cpu_s
  shift 2
  export TACTUS_COUNTS="$logs/$name.counts"
  rm -f "$TACTUS_COUNTS"
  echo "== $name"
  if ! bash "tests/checks/$script" "$@" >"$log" 2>&1 </dev/null; then
    result=FAIL p=0 f=1
  fi
  if [[ -f "$TACTUS_COUNTS" ]]; then
    read -r p f s <"$TACTUS_COUNTS"
    if [[ "$result" == FAIL && $f -eq 0 ]]; then f=1; fi
  fi
  if [[ "$result" == FAIL ]]; then
    tail -n 150 "$log"
  elif [[ $p -eq 0 ]]; then
    result=skip
  fi
  grep '^SKIPPED' "$log" || true
  passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
  count_cpu
  summary+=("$(printf '%-14s %-4s %5d passed %3d failed %3d skipped %5d s, %5d s of CPU' "$name" "$result" "$p" "$f" "$s" \
    $((SECONDS - start)) $((cpu_s - cpu_before_s)))")
  echo "${summary[-1]}"
}

groups=(demo tests)
if [[ -n "$all" || -n "${TACTUS_SOAK:-}" || ${#only[@]} -gt 0 ]]; then groups+=(rig aarch64 armhf riscv64 cortex-m7 packaging); fi
toolchains/install-packages.sh "${groups[@]}"
for stage in "${stages[@]}"; do
  read -r name script arguments <<<"$stage"
  if is_wanted "$name"; then
    # shellcheck disable=SC2086  # the arguments are words
    run_stage "$name" "$script" $arguments
  fi
done

echo
echo "summary ($SECONDS s)"
printf '%s\n' "${summary[@]}"
echo "$passed passed, $failed failed, $skipped skipped"
[[ $failed -eq 0 ]]
