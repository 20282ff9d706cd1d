#!/usr/bin/env bash
# Runs the tests labelled `threads` under the thread sanitizer.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

"$here/build.sh" tsan thread_tests
found="$(ctest --test-dir build/tsan --show-only --label-regex '^threads$' | sed -n 's/^Total Tests: //p')"
if [[ "$found" -eq 0 ]]; then
  echo "SKIPPED thread sanitizer: no test starts a thread"
  echo "0 0 1" >"$TACTUS_COUNTS"
  exit 0
fi
"$here/ctest.sh" tsan --label-regex '^threads$'
