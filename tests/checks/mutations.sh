#!/usr/bin/env bash
# Plants the faults of tests/mutation/faults.txt into a copy of the sources, compiles that once, and shows that for each
# fault some test fails. Names every fault that no test found. How it works: tests/mutation/README.md.
set -euo pipefail
list=tests/mutation/faults.txt
tree=build/mutation/tree
build="$tree/build/release"
export TACTUS_MUTANT_LIMIT_S=60 # a test that a fault keeps from ending has found it
export TACTUS_PROPERTY_TICKS=20000 GTEST_FAIL_FAST=1

tests/checks/build.sh release plant_faults
sources="$(git ls-files --cached --others --exclude-standard | sort)"
faults="$(build/release/tests/plant_faults "$list" . "$tree" <<<"$sources")"
# A file that has gone since the last run goes from the copy, too.
comm -13 <(echo "$sources") <(find "$tree" -path "$tree/build" -prune -o -type f -printf '%P\n' | sort) | sed "s|^|$tree/|" | xargs -r -d '\n' rm --
cmp -s tests/mutation/switch.h "$tree/planted_switch.h" || cp tests/mutation/switch.h "$tree/planted_switch.h"

# The preset is that of the other tests: ccache has the objects that no fault is in.
mapfile -t programs < <(cut -f2 <<<"$faults" | sort -u)
(cd "$tree" && tests/checks/build.sh release "${programs[@]}")

# run NUMBER PROGRAM FILTER: the tests with that fault on; 0 is none.
run() {
  TACTUS_MUTANT="$1" timeout "$TACTUS_MUTANT_LIMIT_S" "$TACTUS_MUTANT_BUILD/tests/$2" --gtest_filter="$3" --gtest_brief=1
}
# try_fault LINE: prints what became of the fault, and the first test that found it.
try_fault() {
  IFS=$'\t' read -r number program filter file name <<<"$1"
  if output="$(run "$number" "$program" "$filter" 2>&1)"; then
    echo "SURVIVED  $number  $file: $name ($program --gtest_filter='$filter')"
  else
    found="$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' <<<"$output" | head -n 1)"
    echo "found     $number  $file: $name, by ${found:-$program, which crashed or did not end}"
  fi
}
export TACTUS_MUTANT_BUILD="$PWD/$build"
export -f run try_fault

echo "without a fault:"
status=0
while IFS=$'\t' read -r program filter; do
  if ! output="$(run 0 "$program" "$filter" 2>&1)" || grep -q " 0 tests from" <<<"$output"; then
    echo "FAILS     $program --gtest_filter='$filter'" && tail -n 20 <<<"$output" && status=1
  fi
done < <(cut -f2,3 <<<"$faults" | sort -u)
[[ $status -eq 0 ]] || exit 1

# shellcheck disable=SC2016  # the inner shell expands it
results="$(xargs -d '\n' -P "$(nproc)" -I{} bash -c 'try_fault "$1"' _ {} <<<"$faults" | sort -k2 -n)"
echo "$results"
survived="$(grep -c '^SURVIVED' <<<"$results" || true)"
echo "$(wc -l <<<"$faults") faults planted, $survived of them found by no test"
echo "$(grep -c '^found' <<<"$results" || true) $survived 0" >"${TACTUS_COUNTS:-/dev/null}"
[[ "$survived" -eq 0 ]]
