#!/usr/bin/env bash
# ctest.sh PRESET [ctest options]: runs the tests of a built preset and writes "passed failed skipped" to $TACTUS_COUNTS. A
# GoogleTest program runs in shards, PROGRAM.1 and so on, and each of its cases counts; any other test counts as one.
set -euo pipefail
preset="$1"
shift
report="$PWD/build/$preset/ctest.xml"
cases="$PWD/build/$preset/gtest"
rm -rf "$report" "$cases"

symbols="external_symbolizer_path=$(command -v llvm-symbolizer-19 || true)"
export ASAN_OPTIONS="detect_stack_use_after_return=1:$symbols" UBSAN_OPTIONS="print_stacktrace=1:$symbols"
export TSAN_OPTIONS="halt_on_error=1:$symbols" GTEST_BRIEF=1
# How long a test may take, s; a soak runs some for an hour or more.
limit=1800
if [[ -n "${TACTUS_SOAK:-}" ]]; then limit=36000; fi
status=0
ctest --test-dir "build/$preset" --parallel "$(nproc)" --timeout "$limit" --no-tests=error --output-on-failure \
  --output-junit "$report" "$@" || status=$?

mapfile -t reports < <(find "$cases" -name '*.xml')
# A shard that crashed leaves no report: it counts as one failure.
awk '
  function attribute(name) { return match($0, " " name "=\"[0-9]+\"") ? substr($0, RSTART + length(name) + 3) + 0 : 0 }
  /<testsuites / { passed += attribute("tests") - attribute("failures") - attribute("disabled"); failed += attribute("failures"); reports++ }
  /<testcase / && / result="skipped"/ { passed--; skipped++ }
  FILENAME == junit && /<testcase / {
    if (/ name="[a-z0-9_]+\.[0-9]+"/) shards++
    else if (/ status="run"/) passed++
    else if (/ status="fail"/) failed++
    else skipped++
  }
  END { print passed + 0, failed + shards - reports, skipped + 0 }' junit="$report" "$report" "${reports[@]}" >"${TACTUS_COUNTS:-/dev/stdout}"

# GoogleTest reports a skip as <skipped message="FILE:LINE&#x0A;REASON">.
awk -v preset="$preset" '
  /<testcase / { match($0, / name="[^"]*"/); name = substr($0, RSTART + 7, RLENGTH - 8)
                 match($0, /classname="[^"]*"/); name = substr($0, RSTART + 11, RLENGTH - 12) "." name }
  /<skipped message=/ { sub(/.*&#x0A;/, ""); sub(/".*/, ""); print "SKIPPED " name " in " preset ": " $0 }' "${reports[@]}" /dev/null
exit "$status"
