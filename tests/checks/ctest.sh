#!/usr/bin/env bash
# ctest.sh PRESET [ctest options]: runs the tests of a built preset and writes "passed failed skipped" to $TACTUS_COUNTS.
set -euo pipefail
preset="$1"
shift
report="$PWD/build/$preset/ctest.xml"
rm -f "$report"

symbols="external_symbolizer_path=$(command -v llvm-symbolizer-19 || true)"
export ASAN_OPTIONS="detect_stack_use_after_return=1:$symbols" UBSAN_OPTIONS="print_stacktrace=1:$symbols"
export TSAN_OPTIONS="halt_on_error=1:$symbols"
# How long a test may take, s; a soak runs some for an hour or more.
limit=900
if [[ -n "${TACTUS_SOAK:-}" ]]; then limit=36000; fi
status=0
ctest --test-dir "build/$preset" --parallel "$(nproc)" --timeout "$limit" --no-tests=error --output-on-failure \
  --output-junit "$report" "$@" || status=$?

count() { sed -n "s/^[[:space:]]*$1=\"\([0-9]*\)\".*/\1/p" "$report" | head -n 1; }
total="$(count tests)" failures="$(count failures)" left_out=$(($(count skipped) + $(count disabled)))
echo "$((total - failures - left_out)) $failures $left_out" >"${TACTUS_COUNTS:-/dev/stdout}"

# GoogleTest prints the reason of a skip on the line below "FILE:LINE: Skipped".
awk -v preset="$preset" '
  /<testcase / { match($0, /name="[^"]*"/); name = substr($0, RSTART + 6, RLENGTH - 7) }
  reason { print "SKIPPED " name " in " preset ": " $0; reason = 0 }
  /: Skipped$/ { reason = 1 }' "$report"
exit "$status"
