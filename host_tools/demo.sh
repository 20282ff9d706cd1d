#!/usr/bin/env bash
# A simulated hand strokes the ears of the Stanford bunny through the real controller: on a fresh Debian 12 this installs
# what is missing (as root or through sudo), builds, bakes, simulates ten seconds and draws two figures.
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

step "1/6 Packages"
toolchains/install-packages.sh demo

step "2/6 Build"
configure
cmake --build build/release --target tactus --parallel "$(nproc)"

step "3/6 The bunny, from Debian's libcgal-demo"
host_tools/bunny_mesh.sh "$out/bunny00.off"
echo "$out/bunny00.off"

step "4/6 Bake it, 15 cm long"
cp host_tools/examples/bunny/scene.toml "$out/scene.toml"
"$tactus" bake "$out/scene.toml" -o "$out/scene.tactus"

step "5/6 Ten seconds of touch: approach, press, stroke across the ears, leave, hover"
"$tactus" sim "$out/scene.tactus" --path host_tools/examples/bunny/wish.csv --output "$out/bunny.csv"

step "6/6 Figures"
"$tactus" plot "$out/bunny.csv" --scene "$out/scene.tactus" -o "$out/"

step "Done. Look at"
printf '  %s\n' "$out/bunny.csv        every tick: tool, proxy, force, contact, friction" \
  "$out/bunny_force.png  force and depth over time" \
  "$out/bunny_path.png   the path over the bunny, from two sides"
