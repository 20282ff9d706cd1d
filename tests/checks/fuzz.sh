#!/usr/bin/env bash
# Builds the fuzz targets and runs each from its corpus for TACTUS_FUZZ_SECONDS, 30 unless set; as many beside each other
# as there are processors.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

cmake --preset fuzz -D "TACTUS_FUZZ_SECONDS=${TACTUS_FUZZ_SECONDS:-30}"
"$here/build.sh" fuzz fuzz_programs
"$here/ctest.sh" fuzz
