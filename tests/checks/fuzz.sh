#!/usr/bin/env bash
# Builds the fuzz targets and runs each from its corpus for TACTUS_FUZZ_SECONDS; unless set, 15, and 600 with --soak. As many
# beside each other as there are processors.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

seconds=15
if [[ -n "${TACTUS_SOAK:-}" ]]; then seconds=600; fi
cmake --preset asan-ubsan -D "TACTUS_FUZZ_SECONDS=${TACTUS_FUZZ_SECONDS:-$seconds}"
"$here/build.sh" asan-ubsan fuzz_programs
"$here/ctest.sh" asan-ubsan --label-regex '^fuzz$'
