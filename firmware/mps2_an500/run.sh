#!/usr/bin/env bash
# Builds the program for the board mps2_an500 and runs it in QEMU. See --help.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cd "$here/../.."

usage() {
  cat <<END
usage: firmware/mps2_an500/run.sh [--ticks N] [--fault NAME] [--trace FILE] [--uart WHERE] [--build] [--help]
Bakes device and scene, links both into the program for a bare Cortex-M7, runs it in QEMU and prints its lines.
  --ticks N      ends after N ticks of a millisecond, a multiple of 1000; 20000 without it
  --fault NAME   runs a program with a planted fault until it has told it:
                   corrupted_image   a wrong byte in the scene image
                   stack_overflow    a function that calls itself without end
                   hung_tick         a tick that does not end
                   nan_sample        an encoder that reads no number
  --trace FILE   writes exceptions and what goes to the motors' lamp and the UART to FILE, in the order of time
  --uart WHERE   gives the UART to a host instead of printing its lines, and runs until Ctrl-C:
                   pty                              a terminal, whose name is printed
                   unix:FILE,server=on,wait=off     a socket, or whatever else QEMU's -serial knows
  --build        makes all these programs, in build/cortex-m7/bin, and runs none
Examples:
  firmware/mps2_an500/run.sh --ticks 5000
  firmware/mps2_an500/run.sh --fault stack_overflow
  firmware/mps2_an500/run.sh --uart pty
END
}

ticks=20000 fault="" trace="" uart="" build_only=""
while [[ $# -gt 0 ]]; do
  case "$1" in
    --ticks) ticks="${2:?--ticks needs a number}" && shift ;;
    --fault) fault="${2:?--fault needs a name}" && shift ;;
    --trace) trace="${2:?--trace needs a file}" && shift ;;
    --uart) uart="${2:?--uart needs a place, such as pty}" && shift ;;
    --build) build_only=1 ;;
    --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
  esac
  shift
done
if [[ ! "$ticks" =~ ^[1-9][0-9]*000$ ]]; then
  echo "run.sh: --ticks $ticks: give a multiple of 1000, such as --ticks 20000" >&2
  exit 2
fi
case "$fault" in
  "" | corrupted_image | stack_overflow | hung_tick | nan_sample) ;;
  *) echo "run.sh: --fault $fault: there are corrupted_image, stack_overflow, hung_tick and nan_sample" >&2 && exit 2 ;;
esac

work="$(mktemp -d)" qemu=""
end() {
  if [[ -n "$qemu" ]]; then kill "$qemu" 2>/dev/null || true; fi
  rm -rf "$work"
}
trap end EXIT
programs=build/cortex-m7/bin images=build/cortex-m7/images

# A step says nothing unless it fails.
quietly() {
  if ! "$@" >"$work/output" 2>&1; then
    cat "$work/output" >&2
    echo "run.sh: '$*' failed" >&2
    exit 1
  fi
}

bake() {
  quietly build/release/bin/tactus bake "$here/$1.toml" -o "$work/$1.tactus"
  mkdir -p "$images"
  # The same image is not linked again.
  cmp --quiet "$work/$1.tactus" "$images/$1.tactus" || cp "$work/$1.tactus" "$images/$1.tactus"
}

echo "building" >&2
quietly tests/checks/build.sh release tactus
bake device
bake scene
quietly tests/checks/build.sh cortex-m7 mps2_an500 mps2_an500_stack_overflow mps2_an500_hung_tick mps2_an500_nan_sample
program="$programs/mps2_an500"
corrupted="${program}_corrupted_image"
cp "$images/scene.tactus" "$work/corrupted.tactus"
printf '\xff' | dd of="$work/corrupted.tactus" bs=1 seek=100001 conv=notrunc status=none
quietly arm-none-eabi-objcopy --update-section ".scene_image=$work/corrupted.tactus" "$program" "$corrupted"
if [[ -n "$build_only" ]]; then exit 0; fi

options=(-M mps2-an500 -display none -monitor none -icount "shift=1,sleep=off" -kernel "$program${fault:+_$fault}")
if [[ -n "$trace" ]]; then
  options+=(-d int -trace mps2_fpgaio_write -trace cmsdk_apb_uart_tx -D "$trace")
fi
if [[ -n "$uart" ]]; then
  rm -rf "$work"
  trap - EXIT
  exec qemu-system-arm "${options[@]}" -serial "$uart"
fi
options+=(-serial stdio)
mkfifo "$work/uart"
# A minute, and as long as a machine takes that is thirty times as slow as the one of the figures.
timeout $((60 + ticks / 200)) qemu-system-arm "${options[@]}" </dev/null >"$work/uart" 2>"$work/errors" &
qemu=$!

# The program never ends by itself: QEMU is stopped at the line that was waited for.
is_complete=""
while [[ -z "$is_complete" ]] && IFS= read -r line; do
  line="${line%$'\r'}"
  echo "$line"
  case "$line" in
    "load $ticks "*) is_complete=$([[ -n "$fault" ]] || echo 1) ;;
    "stopped before:"* | *"mode fault"*) is_complete=1 && if [[ -z "$fault" ]]; then is_complete=bad; fi ;;
  esac
done <"$work/uart"
kill "$qemu" 2>/dev/null || true
wait "$qemu" 2>/dev/null || true
qemu=""
if [[ "$is_complete" != 1 ]]; then
  cat "$work/errors" >&2
  echo "run.sh: the program has stopped, or QEMU has, before the line that was waited for" >&2
  exit 1
fi
