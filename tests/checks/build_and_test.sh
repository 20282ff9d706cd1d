#!/usr/bin/env bash
# build_and_test.sh PRESET [TARGET...]: builds a preset, or targets of it, and runs its tests; those of the programs alone, where targets
# have names that end in _tests.
# The random tests' share of work: a million ticks in release; a fiftieth where a sanitizer or emulation makes them
# thirty times slower; a hundred times as many with --soak.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

ticks=1000000
if [[ "$1" != release ]]; then ticks=$((ticks / 50)); fi
if [[ -n "${TACTUS_SOAK:-}" ]]; then ticks=$((ticks * 100)); fi
export TACTUS_PROPERTY_TICKS="$ticks"

"$here/build.sh" "$@"
programs="$(printf '%s\n' "${@:2}" | sed -n '/_tests$/p' | paste -sd'|')"
"$here/ctest.sh" "$1" --label-exclude '^fuzz$' ${programs:+--tests-regex "^($programs)[.]"}
