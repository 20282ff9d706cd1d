#!/usr/bin/env bash
# A simulated hand strokes the ears of the Stanford bunny through the real controller: on a fresh Debian 12 this installs
# what is missing (as root or through sudo), builds, and lets `tactus demo` do the rest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

out=build/demo
tactus=build/release/bin/tactus

step() { printf '\n==> %s\n' "$*"; }
fail() { printf 'demo.sh: %s\n' "$*" >&2 && exit 1; }
trap 'echo "demo.sh: stopped in line $LINENO; what went wrong stands above" >&2' ERR

if [[ "${1:-}" == "--help" ]]; then
  sed -n 's/^# \?//p' "$0" | sed 1d
  echo "usage: host_tools/demo.sh; everything it writes is in $out and build/release"
  exit 0
fi
[[ $# -eq 0 ]] || fail "takes no arguments; see --help"

# Keeps the tests on where tests/run.sh has built them; the demo's packages alone do not suffice for them.
configure() {
  local tests=OFF
  if grep -qs '^TACTUS_TESTS:BOOL=ON' build/release/CMakeCache.txt; then tests=ON; fi
  cmake --preset release -DTACTUS_TESTS="$tests" -Wno-dev >"$out/configure.log" 2>&1 ||
    { cat "$out/configure.log" >&2 && fail "cmake could not configure build/release"; }
}

mkdir -p "$out"

step "1/4 Packages"
toolchains/install-packages.sh demo

step "2/4 Build"
configure
cmake --build build/release --target tactus --parallel "$(nproc)"

step "3/4 The bunny, from Debian's libcgal-demo"
host_tools/bunny_mesh.sh "$out/bunny00.off"
cp host_tools/examples/bunny/{scene.toml,wish.csv} "$out/"
echo "$out/bunny00.off"

step "4/4 tactus demo: bake the bunny, 15 cm long, stroke it across the ears for ten seconds, and draw that"
"$tactus" demo "$out"
