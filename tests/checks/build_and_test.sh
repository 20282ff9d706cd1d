#!/usr/bin/env bash
# build_and_test.sh PRESET [TARGET]: builds a preset, or one target of it, and runs its tests.
# The random tests' share of work: a million ticks in release; a fiftieth where a sanitizer or emulation makes them
# thirty times slower; a hundred times as many with --soak.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

ticks=1000000
if [[ "$1" != release ]]; then ticks=$((ticks / 50)); fi
if [[ -n "${TACTUS_SOAK:-}" ]]; then ticks=$((ticks * 100)); fi
export TACTUS_PROPERTY_TICKS="$ticks"

"$here/build.sh" "$@"
"$here/ctest.sh" "$1" --label-exclude '^fuzz$'
