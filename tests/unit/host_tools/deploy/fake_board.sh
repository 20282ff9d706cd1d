#!/bin/sh
# A board that is no more than a folder, for the tests of `tactus deploy`. The test calls this file by the names of the programs
# that it stands in for. ssh is found by the host; it runs its command here, with the others first in the path.
#
# Real: dpkg, dpkg-query and dpkg-deb with a database of their own, flock, setsid, tar, sha256sum, and the processes.
# Faked: ssh and its losses, sudo, apt (it asks no archive), the service manager, the journal, tactus, and the passing of time.
#
# TACTUS_FAKE_BOARD is the folder: root/ is the board's /, service the state of tactusd, faults/ has a file for each thing that
# goes wrong, loaded what the service read at its start, calls what was called.
board="$TACTUS_FAKE_BOARD"
name="$(basename "$0")"
export TACTUS_BOARD_ROOT="$board/root"

is_faulty() { [ -e "$board/faults/$1" ]; }
PATH_OF_HOST="${PATH_OF_HOST:-$PATH}"
export PATH_OF_HOST
real() { PATH="$PATH_OF_HOST" "$@"; }
real_dpkg() { real dpkg --root="$board/root" --force-not-root --force-script-chrootless --force-bad-path --force-unsafe-io "$@"; }

play_ssh() {
  while [ "$1" != "--" ]; do shift; done
  command="$3"
  echo "ssh $command" >>"$board/calls"
  if is_faulty unreachable; then
    echo "ssh: connect to host $2: No route to host" >&2
    exit 255
  fi
  export PATH="$board/bin:$PATH_OF_HOST" TMPDIR="$board/root/tmp"
  case "$command" in
    *'tar -C'*)
      if is_faulty cut_while_copying; then
        head -c 2000 | sh -c "$command"
        exit 255
      fi
      ;;
    *board.sh\ start*)
      if is_faulty cut_at_start; then
        # Harder than sshd, which only hangs up: nothing of the session lives on.
        setsid sh -c "$command" >"$board/shown" &
        until [ -s "$board/shown" ]; do real sleep 0.02; done
        kill -KILL "-$!"
        head -n 1 "$board/shown"
        if is_faulty cut_for_good; then : >"$board/faults/unreachable"; fi
        exit 255
      fi
      ;;
  esac
  sh -c "$command"
}

# As dpkg does for apt. What goes wrong leaves what a real apt would leave.
play_apt() {
  for package in "$@"; do
    case "$package" in *.deb) ;; *) continue ;; esac
    if is_faulty apt_finds_no_library; then
      echo 'E: Unable to correct problems, you have held broken packages.' && exit 100
    fi
    if is_faulty apt_fills_the_disk && [ "$package" = ./tactusd.deb ]; then
      echo 'dpkg: error processing archive: cannot copy extracted data: No space left on device' && exit 100
    fi
    if is_faulty apt_is_killed && [ "$package" = ./tactusd.deb ]; then
      real_dpkg --unpack "$package"
      kill -KILL "$PPID"
      exit 100
    fi
    if is_faulty postinst_fails && [ "$package" = ./tactusd.deb ]; then
      real_dpkg --unpack "$package"
      echo 'dpkg: error processing package tactusd (--configure)' && exit 100
    fi
    real_dpkg --force-confold --install "$package" || exit 100
  done
  start_service # as the package's own script does
}

# The service never becomes active with a program or an image that has the word broken in it; with the word crashing it is
# active again and again.
start_service() {
  if grep -qx active "$board/service"; then return 0; fi
  echo 0 >"$board/restarts"
  [ -e "$board/root/etc/tactus/device.tactus" ] || return 0
  if is_faulty nothing_starts || grep -qs broken "$board/root/usr/bin/tactusd" "$board/root/etc/tactus/device.tactus"; then
    echo activating >"$board/service"
  elif is_faulty starts_late; then
    rm "$board/faults/starts_late"
    echo late >"$board/service"
  else
    echo active >"$board/service"
    cat "$board/root/usr/bin/tactusd" "$board"/root/etc/tactus/*.tactus >"$board/loaded"
  fi
}

play_systemctl() {
  case "$*" in
    *is-active*)
      if grep -qs crashing "$board/root/usr/bin/tactusd"; then echo $(($(cat "$board/restarts") + 1)) >"$board/restarts"; fi
      case "$*" in *--quiet*) ;; *) cat "$board/service" ;; esac
      if grep -qx late "$board/service"; then
        start_service
        return 3
      fi
      grep -qx active "$board/service"
      ;;
    *NRestarts*) cat "$board/restarts" ;;
    stop*) echo inactive >"$board/service" ;;
    *start*) start_service ;;
  esac
}

play_tactus() {
  case "$1" in
    status) cat "$board/status" && [ ! -e "$board/faults/no_reply" ] ;;
    doctor)
      grep -qs unwell "$2" && echo 'mend    CAN can0    no such interface' && exit 1
      echo '0 to mend'
      ;;
  esac
}

case "$name" in
  ssh)
    play_ssh "$@"
    exit $?
    ;;
  *) echo "$name $*" >>"$board/calls" ;;
esac
case "$name" in
  sudo) shift && exec "$@" ;;
  apt-get) play_apt "$@" ;;
  dpkg)
    case "$*" in
      *--install*)
        if is_faulty dpkg_cannot_write; then echo 'dpkg: unrecoverable fatal error: Read-only file system' >&2 && exit 2; fi
        ;;
    esac
    real_dpkg "$@" || exit
    case "$*" in *--install*) start_service ;; esac
    ;;
  dpkg-query) real dpkg-query --root="$board/root" "$@" ;;
  systemctl) play_systemctl "$@" ;;
  journalctl) echo 'tactusd: cannot reach the device' ;;
  tactus) play_tactus "$@" ;;
  sleep) if [ "$1" = 0.2 ]; then real sleep 0.05; else real sleep 0.01; fi ;;
  df) if is_faulty no_room; then printf 'Filesystem\n/dev/root 100 99 1 99%% /\n'; else real df "$@"; fi ;;
  sync)
    case "$*" in
      *.tactus.new)
        if is_faulty images_fill_the_disk; then echo 'sync: No space left on device' >&2 && exit 1; fi
        ;;
    esac
    ;;
esac
