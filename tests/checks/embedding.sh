#!/usr/bin/env bash
# embedding.sh PREFIX: builds and runs the example of a project that knows only find_package(tactus), on the installation at PREFIX.
set -euo pipefail
prefix="$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

cp -r "$prefix/share/tactus/examples/embedding" "$work/embedding"
cmake -S "$work/embedding" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix"
cmake --build "$work/build"
if ! grep -q "tactus_DIR:PATH=$prefix" "$work/build/CMakeCache.txt"; then
  echo "embedding: the example has found another installation than that at $prefix" >&2
  exit 1
fi
"$work/build/two_fingers"
