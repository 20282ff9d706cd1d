#!/usr/bin/env bash
# build.sh PRESET [TARGET]: configures a preset and builds everything of it, or one target.
set -euo pipefail

cmake --preset "$1"
cmake --build "build/$1" --target "${2:-all}" --parallel "$(nproc)"
