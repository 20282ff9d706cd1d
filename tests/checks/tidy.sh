#!/usr/bin/env bash
# clang-tidy finds nothing in any translation unit of the release build.
set -euo pipefail
"$(dirname "${BASH_SOURCE[0]}")/build.sh" release  # generated headers have to be there
run-clang-tidy-19 -quiet -p build/release -j "$(nproc)" "^$PWD/(rendering|hal|drivers|firmware|host_tools|tests)/"
