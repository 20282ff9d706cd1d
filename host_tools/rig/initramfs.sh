#!/usr/bin/env bash
# Packs what the emulated machine starts with: busybox, dash, the modules of modules.txt, and the files given, each program with
# its libraries. The same input gives the same bytes. The archive is not compressed: the emulated processor would take longer
# to unpack it than to boot.
#   host_tools/rig/initramfs.sh KERNEL_FOLDER OUTPUT.cpio [FILE[:PATH_IN_THE_MACHINE]]...
# A file without a path goes to /usr/bin; a folder needs one.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
kernel="${1:?usage: initramfs.sh KERNEL_FOLDER OUTPUT.cpio [FILE[:PATH]]...}"
output="${2:?usage: initramfs.sh KERNEL_FOLDER OUTPUT.cpio [FILE[:PATH]]...}"
shift 2
version="$(cat "$kernel/version")"
root="$(mktemp -d)"
trap 'rm -rf "$root"' EXIT

add_libraries() {
  local library
  { ldd "$1" 2>/dev/null || true; } | { grep -oE '/[^ ]+' || true; } | while read -r library; do
    [[ -e "$root$library" ]] || install -D "$library" "$root$library"
  done
}

add() {
  local from="${1%%:*}" to="/usr/bin/"
  if [[ "$1" == *:* ]]; then to="${1#*:}"; fi
  if [[ -d "$from" ]]; then
    mkdir -p "$root$to"
    cp -rL "$from/." "$root$to"
    return
  fi
  if [[ "$to" == */ ]]; then to="$to$(basename "$from")"; fi
  install -D "$from" "$root$to"
  add_libraries "$from"
}

add_busybox() {
  local applet
  install -D /bin/busybox "$root/bin/busybox"
  /bin/busybox --list | while read -r applet; do
    # dash instead of its shell: that one prefers the applets to the programs of the same name.
    case "$applet" in busybox | sh | ash | ip | chrt | init) ;; *) ln -s busybox "$root/bin/$applet" ;; esac
  done
  add /bin/dash:/bin/sh
}

add_modules() {
  local modules="$kernel/lib/modules/$version" name file
  install -D -t "$root/lib/modules/$version" "$modules"/modules.{order,builtin,builtin.modinfo}
  grep -v '^#' "$here/modules.txt" | while read -r name; do
    /sbin/modprobe --dirname "$kernel" --set-version "$version" --show-depends "$name"
  done | grep -oE '[^ ]+\.ko' | sort -u | while read -r file; do
    install -D "$file" "$root/lib/modules/$version/${file#*"/$version/"}"
  done
  /sbin/depmod -b "$root" "$version"
}

mkdir -p "$root"/{bin,dev,proc,sys,tmp,run,results}
add_busybox
add_modules
add "$here/init:/init"
for program in "$(command -v ip)" "$(command -v chrt)" "$(command -v udevadm)"; do add "$program"; done
add /lib/udev/rules.d/50-udev-default.rules:/lib/udev/rules.d/
mkdir -p "$root/usr/lib/systemd"
ln -s /usr/bin/udevadm "$root/usr/lib/systemd/systemd-udevd"
for file in "$@"; do add "$file"; done

find "$root" -exec touch -h -d @1767225600 {} +
(cd "$root" && find . | LC_ALL=C sort | cpio --quiet -o -H newc --reproducible) >"$output"
