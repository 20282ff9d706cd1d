#!/usr/bin/env bash
# A simulated hand strokes the ears of the Stanford bunny through the real controller: on a fresh Debian 12 this installs
# what is missing (as root or through sudo), builds, bakes, simulates ten seconds and draws two figures.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

out=build/demo
tactus=build/release/bin/tactus
archive=/usr/share/doc/libcgal-dev/data.tar.gz  # of libcgal-demo
mesh=data/meshes/bunny00.off                    # in that archive: 37,706 vertices, 75,408 triangles

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

# Slim images leave documentation out when they install a package: the mesh is then taken from the package itself.
archive_from_package() (
  folder="$(mktemp -d)"
  trap 'rm -rf "$folder"' EXIT
  chmod 755 "$folder"
  cd "$folder"
  apt-get download -qq libcgal-demo >&2
  dpkg-deb --fsys-tarfile libcgal-demo_*.deb | tar --extract --to-stdout ".$archive"
)

extract_bunny() {
  if [[ -f "$archive" ]]; then
    tar --extract --gzip --to-stdout --file "$archive" "$mesh" >"$1"
  else
    archive_from_package | tar --extract --gzip --to-stdout "$mesh" >"$1"
  fi
}

mkdir -p "$out"

step "1/6 Packages"
toolchains/install-packages.sh demo

step "2/6 Build"
configure
cmake --build build/release --target tactus --parallel "$(nproc)"

step "3/6 The bunny, from Debian's libcgal-demo"
extract_bunny "$out/bunny00.off.part" || fail "cannot get $mesh out of libcgal-demo"
[[ "$(sed -n 2p "$out/bunny00.off.part")" == "37706 75408 0" ]] || fail "$mesh is not the bunny that was expected"
mv "$out/bunny00.off.part" "$out/bunny00.off"
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
