#!/usr/bin/env bash
# build.sh PRESET [TARGET...]: configures a preset and builds everything of it, or the targets.
set -euo pipefail
preset="$1"
shift

# One checkout uses the objects that another has compiled.
export CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=true

cmake --preset "$preset"
cmake --build "build/$preset" --target "${@:-all}" --parallel "$(nproc)"
