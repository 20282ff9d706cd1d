#!/usr/bin/env bash
# Makes Debian packages of this checkout for one processor; see --help.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/checks/tracked_files.sh

usage() {
  cat <<END
usage: toolchains/debian-packages.sh [ARCHITECTURE]
Makes tactus, tactusd, libtactus-dev and, for the processor of this machine, python3-tactus for Debian 12 in build/packages/ARCHITECTURE.
ARCHITECTURE: amd64, arm64, armhf; by default this machine's. Installs what it needs, as root or through sudo; the libraries for another
processor go into a sysroot.
Example:
  toolchains/debian-packages.sh arm64 && scp build/packages/arm64/*.deb board:
END
}

case "${1:-}" in
  --help) usage && exit 0 ;;
  amd64 | arm64 | armhf | "") ;;
  *) usage >&2 && exit 2 ;;
esac
[[ $# -le 1 ]] || { usage >&2 && exit 2; }
machine="$(dpkg --print-architecture)"
architecture="${1:-$machine}"
folder="build/packages/$architecture"
source="$folder/source"

groups=(demo packaging)
if [[ "$architecture" != "$machine" ]]; then
  case "$architecture" in
    arm64) groups+=(aarch64) ;;
    armhf) groups+=(armhf) ;;
    *) echo "debian-packages: $architecture is made on a machine of its own alone" >&2 && exit 2 ;;
  esac
fi
toolchains/install-packages.sh "${groups[@]}"

# Packages are made in a copy of the checkout, which debhelper may fill with its files. A build there goes on where the last one ended.
copy_checkout() {
  local kept="$folder/kept-build"
  mkdir -p "$folder"
  rm -f "$folder"/*.deb "$folder"/tactus_*
  if [[ -d "$source/build" ]]; then mv "$source/build" "$kept"; fi
  rm -rf "$source"
  mkdir -p "$source"
  tracked_files '*' | xargs -d '\n' cp --parents --preserve=mode,timestamps -t "$source"
  if [[ -d "$kept" ]]; then mv "$kept" "$source/build"; fi
}

# debhelper asks for these words where it makes packages for another processor; tests/run.sh runs the tests.
say_cross_build() { export DEB_BUILD_PROFILES="cross nocheck" DEB_BUILD_OPTIONS=nocheck; }

# The sysroot is seen within the copy, where the compiler's command line is the same as in the checkout. dpkg's records of its
# packages name its files where they are.
link_sysroot() {
  local root records file
  toolchains/sysroot.sh "$architecture"
  root="$(realpath "build/sysroot/$architecture")"
  records="$source/build/dpkg"
  mkdir -p "$source/build/sysroot"
  ln -sfn "$root" "$source/build/sysroot/$architecture"
  rm -rf "$records"
  cp -r "$root/var/lib/dpkg" "$records"
  for file in "$records"/info/*.list; do sed -i "s|^|$root|" "$file"; done
}

copy_checkout
if [[ "$architecture" != "$machine" ]]; then
  link_sysroot
  say_cross_build
fi

# The objects of another checkout, or of another build of this one, are taken from the cache.
# debhelper gives its programs a home folder of their own, in which that cache is not.
CCACHE_DIR="$(ccache --get-config cache_dir)"
export CCACHE_DIR CCACHE_BASEDIR="$PWD/$source" CCACHE_NOHASHDIR=true
SOURCE_DATE_EPOCH="$(git -c safe.directory="$PWD" log -1 --format=%ct 2>/dev/null || date +%s)"
export SOURCE_DATE_EPOCH
# -nc: the build goes on; -d: a board's libraries are in the sysroot, and of this machine's packages toolchains/packages.txt decides.
(cd "$source" && dpkg-buildpackage --host-arch "$architecture" --build=binary --no-sign --no-pre-clean --no-check-builddeps \
  -j"$(nproc)")
ls "$folder"/*.deb
