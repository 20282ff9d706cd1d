#!/usr/bin/env bash
# build_and_test.sh PRESET: builds a preset and runs its tests.
# Tests labelled `slow` are left out under emulation, about thirty times slower, unless TACTUS_SOAK is set.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

"$here/build.sh" "$1"
if [[ "$1" != aarch64 || -n "${TACTUS_SOAK:-}" ]]; then
  exec "$here/ctest.sh" "$1"
fi

"$here/ctest.sh" "$1" --label-exclude '^slow$'
slow="$(ctest --test-dir "build/$1" --show-only --label-regex '^slow$' | sed -n 's/^Total Tests: //p')"
if [[ "$slow" -gt 0 ]]; then
  echo "SKIPPED $slow slow tests in $1: they ran in release; --soak runs them here too"
  read -r passed failed skipped <"$TACTUS_COUNTS"
  echo "$passed $failed $((skipped + slow))" >"$TACTUS_COUNTS"
fi
