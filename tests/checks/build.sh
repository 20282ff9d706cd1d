#!/usr/bin/env bash
# build.sh PRESET: configures and builds everything of a preset.
set -euo pipefail

cmake --preset "$1"
cmake --build "build/$1" --parallel "$(nproc)"
