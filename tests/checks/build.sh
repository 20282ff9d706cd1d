#!/usr/bin/env bash
# build.sh PRESET [TARGET...]: configures a preset and builds everything of it, or the targets.
set -euo pipefail
preset="$1"
shift

# One checkout uses the objects that another has compiled.
export CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=true

# The libraries of a Linux board.
case "$preset" in
  aarch64) toolchains/sysroot.sh arm64 ;;
  armhf | armhf-quick) toolchains/sysroot.sh armhf ;;
esac

cmake --preset "$preset"
cmake --build "build/$preset" --target "${@:-all}" --parallel "$(nproc)"
