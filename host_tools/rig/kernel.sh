#!/usr/bin/env bash
# Makes FOLDER/vmlinux and FOLDER/lib/modules: Debian's PREEMPT_RT kernel, the one whose headers are installed, unpacked and never
# installed itself, with the module gpio-sim that Debian leaves out.
#   host_tools/rig/kernel.sh FOLDER
# Does nothing where both are there. Takes half a minute and 700 MB of temporary space.
set -euo pipefail
folder="${1:?usage: kernel.sh FOLDER}"

fail() {
  echo "kernel.sh: $*" >&2
  exit 1
}

headers="$(dpkg-query -W -f='${Depends}' linux-headers-rt-amd64 2>/dev/null | grep -oE 'linux-headers-[^ ,]+' | head -n 1)" ||
  fail "no linux-headers-rt-amd64; run toolchains/install-packages.sh rig"
version="${headers#linux-headers-}"
mkdir -p "$folder"
folder="$(cd "$folder" && pwd)"
if [[ "$(cat "$folder/version" 2>/dev/null)" == "$version" ]]; then
  exit 0
fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
release="$(dpkg-query -W -f='${Version}' "$headers")"

# Only what a rig may load: tar is given patterns, a whole kernel is 4,000 modules.
unpack_kernel() {
  echo "rig: downloading and unpacking the kernel $version"
  (cd "$work" && apt-get -qq -o APT::Sandbox::User=root download "linux-image-$version=$release")
  dpkg --fsys-tarfile "$work"/linux-image-*.deb >"$work/image.tar"
  tar -C "$work" -xf "$work/image.tar" --wildcards './boot/vmlinuz-*' \
    "./lib/modules/$version/modules.*" "./lib/modules/$version/kernel/net/can/*" \
    "./lib/modules/$version/kernel/drivers/net/can/*" "./lib/modules/$version/kernel/drivers/usb/*" \
    "./lib/modules/$version/kernel/fs/configfs/*" "./lib/modules/$version/kernel/drivers/virtio/*" \
    "./lib/modules/$version/kernel/drivers/block/virtio_blk.ko"
  rm "$work/image.tar"
}

# An uncompressed kernel boots in half the time.
unpack_vmlinux() {
  local compressed offset
  compressed="$(echo "$work"/boot/vmlinuz-*)"
  offset="$(LC_ALL=C grep -obaP -m 1 '\xFD7zXZ\x00' "$compressed" | head -n 1 | cut -d: -f1)"
  [[ -n "$offset" ]] || fail "no xz stream in $compressed"
  tail -c "+$((offset + 1))" "$compressed" | xz -dc --single-stream >"$work/vmlinux" 2>/dev/null || true
  [[ "$(head -c 4 "$work/vmlinux")" == $'\x7fELF' ]] || fail "could not unpack $compressed"
}

# In 6.1.y the simulated interrupt takes the plain handler, which PREEMPT_RT refuses outside of interrupts.
build_gpio_sim() {
  local source="$work/gpio-sim"
  echo "rig: building gpio-sim"
  mkdir -p "$source"
  tar -C "$source" -xf /usr/src/linux-source-6.1.tar.xz --strip-components=1 --occurrence=1 \
    linux-source-6.1/drivers/gpio/gpio-sim.c linux-source-6.1/drivers/gpio/gpiolib.h \
    linux-source-6.1/drivers/gpio/gpiolib-cdev.h linux-source-6.1/kernel/irq/irq_sim.c
  sed -i 's/handle_simple_irq(irq_to_desc(irqnum))/generic_handle_irq_safe(irqnum)/' "$source/kernel/irq/irq_sim.c"
  printf '%s\n' 'obj-m := gpio-sim-oot.o' 'gpio-sim-oot-y := drivers/gpio/gpio-sim.o kernel/irq/irq_sim.o' >"$source/Kbuild"
  make -s -C "/usr/src/linux-headers-$version" M="$source" modules >"$work/gpio-sim.log" 2>&1 ||
    fail "gpio-sim does not build: $(tail -n 5 "$work/gpio-sim.log")"
  mkdir -p "$work/lib/modules/$version/extra"
  cp "$source/gpio-sim-oot.ko" "$work/lib/modules/$version/extra/"
}

unpack_kernel
unpack_vmlinux
build_gpio_sim
/sbin/depmod -b "$work" "$version"
rm -rf "${folder:?}/lib"
mv "$work/lib" "$folder/lib"
mv "$work/vmlinux" "$folder/vmlinux"
echo "$version" >"$folder/version"
