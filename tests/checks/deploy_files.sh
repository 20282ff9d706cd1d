#!/usr/bin/env bash
# Checks the files that cmake --install puts in place for a Linux board with the programs that read them there: systemd, udev, sysusers.
#   tests/checks/deploy_files.sh PREFIX    of an installation
set -euo pipefail
prefix="$1"
rules="$prefix/lib/udev/rules.d"
messages="$(mktemp)"
trap 'rm -f "$messages"' EXIT

fail() { echo "deployment: $*" >&2; exit 1; }

for file in bin/tactusd lib/systemd/system/tactusd.service lib/udev/rules.d/99-tactus.rules lib/sysusers.d/tactus.conf \
  lib/sysctl.d/90-tactus.conf etc/security/limits.d/90-tactus.conf etc/tactus/tactusd.env share/doc/tactus/deploy.md; do
  [[ -s "$prefix/$file" ]] || fail "$file is not installed"
done

# Says nothing about a unit in which it finds nothing.
systemd-analyze verify --man=no "$prefix/lib/systemd/system/tactusd.service" 2>"$messages" || fail "$(cat "$messages")"
[[ ! -s "$messages" ]] || fail "$(cat "$messages")"
# 10 is no protection, 0 is all there is; what is left open is what the devices and real time need: 2.5 at most.
systemd-analyze security --offline=yes --threshold=25 "$prefix/lib/systemd/system/tactusd.service" >"$messages" ||
  fail "the service is less protected than it was: $(tail -n 1 "$messages")"

systemd-sysusers --dry-run "$prefix/lib/sysusers.d/tactus.conf" >"$messages" 2>&1 || fail "$(cat "$messages")"

# udevd 252 has no verify. It reads all rules before it tests a device, here one without a file in /dev; in a name space of
# our own, so that the rules are nobody else's, or where that is forbidden as root in /run.
# A rule for serial ports or USB devices names the device that it is for.
while read -r rule; do
  case "$rule" in
    *idVendor*idProduct*) ;;
    *) fail "a rule for serial ports or USB devices matches all of them: $rule" ;;
  esac
done < <(grep -E '^SUBSYSTEM=="(tty|usb)"' "$rules/99-tactus.rules")

udev_reads_rules() {
  if unshare --user --map-root-user --mount true 2>"$messages"; then
    # shellcheck disable=SC2016  # the inner shell's argument
    unshare --user --map-root-user --mount \
      sh -c 'mount --bind "$1" /etc/udev/rules.d && udevadm test --resolve-names=never /sys/class/net/lo' sh "$rules"
  else
    mkdir -p /run/udev/rules.d
    cp "$rules/99-tactus.rules" /run/udev/rules.d/
    udevadm test --resolve-names=never /sys/class/net/lo
    rm /run/udev/rules.d/99-tactus.rules
  fi
}
udev_reads_rules >"$messages" 2>&1 || fail "$(cat "$messages")"
grep -qE 'Reading rules file: .*/99-tactus.rules' "$messages" || fail "udevadm did not read the rules: $(cat "$messages")"
if grep -E '99-tactus.rules:[0-9]+ ' "$messages" | grep -vF 'Resolving group name is disabled'; then
  fail "udev does not understand the rules"
fi
echo "deployment: service, rules, group, limits and sysctl are in place"
