#!/usr/bin/env bash
# Runs one scenario in the emulated machine and brings its results back. The machine goes on from the snapshot that snapshot.sh
# has left beside the initramfs; without one, or with options of its own, it boots.
#   host_tools/rig/boot.sh KERNEL_FOLDER INITRAMFS.cpio SCENARIO RESULTS_FOLDER [QEMU_OPTION]...
# The console goes to RESULTS_FOLDER/console.log, the machine's /results beside it. Exit code 0: the scenario passed; 1: it
# failed; 2: the machine did not come to an end (limit: TACTUS_RIG_LIMIT_S seconds, 900;
# 7200 with TACTUS_SOAK, which the scenario finds in its environment).
set -euo pipefail
# shellcheck source=host_tools/rig/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/machine.sh"
usage="usage: boot.sh KERNEL_FOLDER INITRAMFS.cpio SCENARIO RESULTS_FOLDER [QEMU_OPTION]..."
kernel="${1:?$usage}" initramfs="${2:?$usage}" scenario="${3:?$usage}" results="${4:?$usage}"
shift 4
snapshot="${initramfs%.cpio}.snapshot"
rm -rf "$results"
mkdir -p "$results"

number="$(cpio --quiet -t <"$initramfs" | grep '^\(\./\)\?rig/.*\.sh$' | LC_ALL=C sort | grep -n "rig/$scenario\.sh\$" | cut -d: -f1 || true)"
if [[ -z "$number" ]]; then
  echo "boot.sh: $initramfs has no scenario '$scenario'" >&2
  exit 2
fi
limit_s=900
if [[ -n "${TACTUS_SOAK:-}" ]]; then limit_s=7200; fi
limit_s="${TACTUS_RIG_LIMIT_S:-$limit_s}"

code=0
if [[ $# -eq 0 && "$snapshot" -nt "$initramfs" ]]; then
  begin_machine "$kernel" "$initramfs" "$number" "$results" "$limit_s" -incoming "exec:cat '$snapshot'"
  if wait_until_stopped; then echo cont >&"$to_monitor"; fi
  wait "$machine" || code=$?
else
  run_machine "$kernel" "$initramfs" "$number" "$results" "$limit_s" -monitor none "$@" </dev/null >>"$results/console.log" || code=$?
fi
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
