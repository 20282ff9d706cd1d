#!/usr/bin/env bash
# Installs the release build to an empty prefix; builds and runs there a project that knows only find_package(tactus), and
# reads what a Linux board gets.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

"$(dirname "${BASH_SOURCE[0]}")/build.sh" release
cmake --install build/release --prefix "$work/prefix"
cp -r host_tools/examples/embedding "$work/embedding"
cmake -S "$work/embedding" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/build"
"$work/build/two_fingers"
tests/checks/deploy_files.sh "$work/prefix"
