# shellcheck shell=bash
# The emulated machine and its monitor, for boot.sh and snapshot.sh. Its clock counts instructions, so that a run repeats
# whatever else this machine does. The kernel leaves out what protects one program from another's speculation, which the emulated
# processor does not do.

# run_machine KERNEL_FOLDER INITRAMFS.cpio NUMBER FOLDER LIMIT_S [QEMU_OPTION]...: runs the scenario of that number, or with 0
# boots until init stops the machine. FOLDER gets console.log and the machine's disk, results.tar.
run_machine() {
  local kernel="$1" initramfs="$2" number="$3" folder="$4" limit_s="$5"
  shift 5
  truncate -s 64M "$folder/results.tar"
  timeout "$limit_s" qemu-system-x86_64 -accel tcg -cpu qemu64 -smp 1 -m 768 \
    -icount shift=1,sleep=off -rtc base=2026-01-01,clock=vm -nographic -no-reboot -nodefaults -M q35 \
    -chardev "file,id=console,path=$folder/console.log,append=on" -serial chardev:console \
    -drive "file=$folder/results.tar,format=raw,if=virtio" -device isa-debug-exit,iobase=0xf4,iosize=0x04 \
    -chardev null,id=number -device "isa-debugcon,iobase=0x402,chardev=number,readback=$number" \
    -device pvpanic,ioport=0x505 -action panic=pause \
    -kernel "$kernel/vmlinux" -initrd "$initramfs" \
    -append "console=ttyS0 quiet panic=-1 mitigations=off${TACTUS_SOAK:+ TACTUS_SOAK=1}" "$@" 2>>"$folder/console.log"
}

# begin_machine ARGUMENT...: run_machine, with the file descriptors $to_monitor and $from_monitor to its monitor; $machine is its
# process.
begin_machine() {
  trap '' PIPE # a machine that has ended reads no more
  coproc monitor { run_machine "$@" -monitor stdio; }
  # shellcheck disable=SC2034,SC2154  # coproc sets the one, callers read the other
  machine="$monitor_PID"
  exec {to_monitor}>&"${monitor[1]}" {from_monitor}<&"${monitor[0]}"
}

# Returns once init has stopped the machine before the scenario; fails if the machine has ended.
wait_until_stopped() {
  local line
  while echo 'info status' >&"$to_monitor"; do
    while read -r -t 0.1 line <&"$from_monitor"; do
      if [[ "$line" == *'(guest-panicked)'* ]]; then return; fi
    done
  done 2>/dev/null
  return 1
}
