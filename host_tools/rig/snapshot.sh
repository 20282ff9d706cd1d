#!/usr/bin/env bash
# Boots the emulated machine as far as a scenario begins, and keeps its state there: boot.sh goes on from it, which spares
# each scenario the boot.
#   host_tools/rig/snapshot.sh KERNEL_FOLDER INITRAMFS.cpio
# The state goes to INITRAMFS.snapshot.
set -euo pipefail
# shellcheck source=host_tools/rig/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/machine.sh"
usage="usage: snapshot.sh KERNEL_FOLDER INITRAMFS.cpio"
kernel="${1:?$usage}" initramfs="${2:?$usage}"
snapshot="${initramfs%.cpio}.snapshot"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
rm -f "$snapshot"

begin_machine "$kernel" "$initramfs" 0 "$folder" 300
if wait_until_stopped; then
  printf '%s\n' 'migrate_set_parameter max-bandwidth 10G' "migrate \"exec:cat >'$snapshot.part'\"" quit >&"$to_monitor"
  cat <&"$from_monitor" >"$folder/monitor.log"
fi
if ! wait "$machine" || [[ ! -s "$snapshot.part" ]]; then
  echo "snapshot.sh: the machine did not come to where a scenario begins" >&2
  cat "$folder"/*.log >&2
  exit 1
fi
mv "$snapshot.part" "$snapshot"
