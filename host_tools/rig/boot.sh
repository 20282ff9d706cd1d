#!/usr/bin/env bash
# Boots the emulated machine, runs one scenario in it and brings its results back. Its clock counts instructions, so that a run
# repeats whatever else this machine does. The kernel leaves out what protects one program from another's speculation, which the
# emulated processor does not do, and tests neither its ciphers nor its timer's interrupt, which take half of the boot.
#   host_tools/rig/boot.sh KERNEL_FOLDER INITRAMFS.cpio SCENARIO RESULTS_FOLDER [QEMU_OPTION]...
# The console goes to RESULTS_FOLDER/console.log, the machine's /results beside it. Exit code 0: the scenario passed; 1: it
# failed; 2: the machine did not come to an end (limit: TACTUS_RIG_LIMIT_S seconds, 900;
# 7200 with TACTUS_SOAK, which the scenario finds in its environment).
set -euo pipefail
usage="usage: boot.sh KERNEL_FOLDER INITRAMFS.cpio SCENARIO RESULTS_FOLDER [QEMU_OPTION]..."
kernel="${1:?$usage}" initramfs="${2:?$usage}" scenario="${3:?$usage}" results="${4:?$usage}"
shift 4
rm -rf "$results"
mkdir -p "$results"
truncate -s 64M "$results/results.tar"

code=0 limit_s=900
if [[ -n "${TACTUS_SOAK:-}" ]]; then limit_s=7200; fi
timeout "${TACTUS_RIG_LIMIT_S:-$limit_s}" qemu-system-x86_64 -accel tcg -cpu qemu64 -smp 1 -m 768 \
  -icount shift=1,sleep=off -rtc base=2026-01-01,clock=vm -nographic -no-reboot -nodefaults -M q35 \
  -serial stdio -drive "file=$results/results.tar,format=raw,if=virtio" -device isa-debug-exit,iobase=0xf4,iosize=0x04 \
  -kernel "$kernel/vmlinux" -initrd "$initramfs" -append "console=ttyS0 quiet panic=-1 mitigations=off cryptomgr.notests no_timer_check rig=$scenario${TACTUS_SOAK:+ TACTUS_SOAK=1}" "$@" \
  </dev/null >"$results/console.log" 2>&1 || code=$?
tr -d '\r' <"$results/console.log" >"$results/console.txt" && mv "$results/console.txt" "$results/console.log"
tar -C "$results" -xf "$results/results.tar"
rm "$results/results.tar"
case "$code" in
  33) exit 0 ;;
  35) exit 1 ;;
  *)
    echo "boot.sh: the machine ended with QEMU's exit code $code; see $results/console.log" >&2
    exit 2
    ;;
esac
