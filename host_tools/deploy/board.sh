#!/bin/sh
# `tactus deploy` copies this script to the board with the packages and the images. It installs them and puts everything back
# where that fails. README.md has the steps and the exit codes. It goes on when the connection ends.
#   sh board.sh start OPTION...   begins as root in the background, then shows the progress
#   sh board.sh show LINE         shows the progress from that line on, and ends with the exit code of the deployment
# Options: --force --ignore-doctor --no-rollback --timeout SECONDS. TACTUS_BOARD_ROOT is a folder in place of /, for tests.
set -u
cd "$(dirname "$0")" || exit 2
PATH="$PATH:/usr/sbin:/sbin"

root="${TACTUS_BOARD_ROOT:-}"
etc="$root/etc/tactus"
images="device.tactus scene.tactus"
settings="tactusd.env tactusd.env.dpkg-dist" # dpkg leaves the second beside one that was changed here
packages="tactus tactusd"
state="$root/var/lib/tactus-deploy"
kept="$state/kept"       # the packages of the last deployment that succeeded
pending="$state/pending" # what the board had before a deployment that is not over

force='' ignore_doctor='' no_rollback='' timeout=30 locked='' recovering=''

say() { printf '%s\n' "$*"; }
# A full disk may keep the words from the log, and not the script from its end.
fail() {
  say "failed: $*"
  exit 2
}

# shellcheck source=host_tools/deploy/board_state.sh
. ./board_state.sh

# ---- Before anything changes

lock() {
  mkdir -p "$state" || fail "cannot make $state"
  chmod 700 "$state"
  exec 9>"$state/lock" || fail "cannot write $state/lock"
  flock --nonblock 9 || fail "another deployment to this board is going on; wait until it is over"
  locked=yes
}

# A deployment that was cut off by a loss of power has left what the board had before.
recover() {
  [ -d "$pending" ] || return 0
  say "the deployment before this one was cut off: putting back what it found"
  put_back || fail "that did not succeed; see above, mend it by hand and remove $pending"
}

check_packages() {
  wanted="$(dpkg --print-architecture)"
  for package in $packages; do
    for_board="$(dpkg-deb --field "$package.deb" Architecture)" || fail "$package.deb is no package"
    [ "$for_board" = "$wanted" ] || fail "$package.deb is for $for_board, this board takes $wanted"
    if is_half_installed "$package"; then
      fail "the package $package is half installed; mend it on the board: sudo dpkg --configure -a"
    fi
  done
}

check_space() {
  # Three times what the packages take: what is there, what comes, and what is kept for the next roll-back.
  needed=0
  for package in $packages; do
    size="$(dpkg-deb --field "$package.deb" Installed-Size)"
    needed=$((needed + 3 * ${size:-0}))
  done
  for folder in "$root/usr" "$state"; do
    free="$(df -Pk "$folder" | awk 'NR == 2 {print $4}')"
    [ "${free:-0}" -ge "$needed" ] ||
      fail "the disk of $folder has $free KiB free, the deployment takes $needed; make room, for example: sudo apt-get clean"
  done
}

# An image that the service does not read would be installed in vain.
check_names() {
  [ -e "$etc/tactusd.env" ] || return 0
  for image in $images; do
    variable="TACTUSD_$(basename "$image" .tactus | tr '[:lower:]' '[:upper:]')"
    named="$(sed -n "s/^$variable=//p" "$etc/tactusd.env" | tail -n 1)"
    if [ -e "$image" ] && [ "$named" != "/etc/tactus/$image" ]; then
      fail "/etc/tactus/tactusd.env has $variable=$named; write $variable=/etc/tactus/$image there, or deploy without this image"
    fi
  done
}

check_rest() {
  systemctl --quiet is-active tactusd || return 0
  [ -z "$force" ] || return 0
  for folder in "$root"/run/tactus "$root"/run/tactus/[0-9]*; do
    [ -d "$folder" ] || continue
    reply="$(tactus status --run-dir "$folder" 2>&1)" ||
      fail "tactusd runs and does not say whether it is at rest ($reply); stop it first (sudo systemctl stop tactusd), or deploy with --force"
    case "$reply " in
      *' mode=active '* | *' mode=homing '*)
        fail "a hand may feel the forces of tactusd ($reply); take them away first (tactus disable), or deploy with --force"
        ;;
    esac
  done
}

check_roll_back() {
  for package in $packages; do
    if is_installed "$package" && ! is_installed_from "$package" "$kept/$package.deb" && [ -z "$no_rollback" ]; then
      fail "the board has $package from elsewhere, and no $kept/$package.deb to put it back from; copy that .deb there, or deploy with --no-rollback"
    fi
  done
}

# ---- The deployment

stop_service() {
  case "$(cat "$pending/service")" in
    active | activating) ;;
    *) return 0 ;;
  esac
  say "stopping tactusd: its motors are off"
  systemctl stop tactusd || fail "tactusd cannot be stopped"
}

install_packages() {
  say "installing the packages"
  DEBIAN_FRONTEND=noninteractive apt-get --yes -qq --reinstall --allow-downgrades --no-install-recommends \
    -o DPkg::Options::=--force-confold -o DPkg::Lock::Timeout=60 -o DPkg::Use-Pty=0 install ./tactus.deb ./tactusd.deb 9>&- ||
    fail "apt cannot install the packages; if it lacks libraries: sudo apt-get update, and bookworm-backports for libgpiod3"
  for package in $packages; do
    is_installed_from "$package" "$package.deb" || fail "apt did not install $package"
  done
}

# A reader sees the old image or the whole new one.
install_images() {
  for image in $images; do
    [ -e "$image" ] || continue
    say "installing $etc/$image"
    if ! { mkdir -p "$etc" && cp "$image" "$etc/$image.new" && chmod 644 "$etc/$image.new" && sync "$etc/$image.new" &&
      mv "$etc/$image.new" "$etc/$image" && sync "$etc"; }; then
      fail "cannot write $etc/$image"
    fi
  done
}

bring_up() {
  if [ ! -e "$etc/device.tactus" ]; then
    say "tactusd waits for the image of a device: deploy one with --device"
    return 0
  fi
  say "starting tactusd"
  if ! start_service || ! is_active; then
    journalctl --unit tactusd --lines 10 --no-pager
    fail "tactusd did not become active within $timeout s; its last words are above"
  fi
  say "tactus doctor $etc/device.tactus"
  tactus doctor "$etc/device.tactus"
  code=$?
  [ "$code" = 0 ] || [ "$code" = 2 ] || [ -n "$ignore_doctor" ] ||
    fail "the doctor found something to mend; mend it, or deploy with --ignore-doctor"
  systemctl --quiet is-active tactusd || fail "tactusd has ended meanwhile: journalctl -u tactusd"
}

# The deployment counts from the moment in which $pending is renamed.
keep() {
  if ! { rm -rf "$kept.new" && mkdir "$kept.new" && cp tactus.deb tactusd.deb "$kept.new/" && sync && rm -rf "$kept" &&
    mv "$kept.new" "$kept" && mv "$pending" "$pending.over"; }; then
    fail "cannot keep the packages in $kept"
  fi
  rm -rf "$pending.over"
}

at_end() {
  code=$?
  trap - EXIT
  trap '' INT TERM
  if [ -n "$locked" ]; then
    rm -rf "$pending.new" "$kept.new"
    if [ -d "$pending" ] && [ -z "$recovering" ]; then
      say "putting back what was there before"
      if put_back; then
        say "everything is as it was before"
        code=1
      else
        say "not everything is as it was before; $pending has what is missing"
        code=3
      fi
    elif [ -d "$pending" ]; then
      code=3
    fi
  fi
  # In place: a full disk has room for it.
  echo "$code" 1<>result.new && mv result.new result
  exit "$code"
}

deploy() {
  while [ $# -gt 0 ]; do
    case "$1" in
      --force) force=yes ;;
      --ignore-doctor) ignore_doctor=yes ;;
      --no-rollback) no_rollback=yes ;;
      --timeout) timeout="$2" && shift ;;
    esac
    shift
  done
  trap '' HUP PIPE
  trap 'say "stopped by a signal"; exit 2' INT TERM
  trap at_end EXIT
  lock
  recovering=yes
  recover
  recovering=''
  check_packages
  check_space
  check_names
  check_rest
  check_roll_back
  save
  stop_service
  install_packages
  install_images
  bring_up
  keep
  say "deployed"
  exit 0
}

# ---- From the host

begin() {
  : >log
  echo 3 >result.new
  as_root=''
  if [ "$(id -u)" != 0 ]; then as_root='sudo -n'; fi
  # shellcheck disable=SC2086  # empty for root
  setsid $as_root sh board.sh deploy "$@" </dev/null >>log 2>&1 &
  echo $! >pid.new && mv pid.new pid
}

show() {
  line="$1"
  [ -e pid ] || fail "the deployment was not begun"
  while :; do
    over=''
    if [ -e result ]; then
      over=result
    elif [ ! -d "/proc/$(cat pid)" ] && [ ! -e result ]; then
      over=died
    fi
    last="$(wc -l <log)"
    if [ "$last" -ge "$line" ]; then
      sed -n "$line,${last}p" log || exit 255
      line=$((last + 1))
    fi
    case "$over" in
      result) exit "$(cat result)" ;;
      died)
        say "the deployment was killed; the next one puts back what it found"
        exit 3
        ;;
    esac
    sleep 0.2
  done
}

case "${1:-}" in
  start) shift && begin "$@" && show 1 ;;
  show) show "${2:-1}" ;;
  deploy) shift && deploy "$@" ;;
  *) fail "board.sh takes start, show or deploy" ;;
esac
