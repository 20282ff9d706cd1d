# What the board has, and how it is put back. board.sh reads this file; its variables are those of board.sh.
# shellcheck shell=sh disable=SC2154

# ---- Packages

state_of() { dpkg-query --show --showformat '${db:Status-Status}' "$1" 2>/dev/null; }
is_installed() { [ "$(state_of "$1")" = installed ]; }
is_half_installed() {
  case "$(state_of "$1")" in
    '' | installed | not-installed | config-files) return 1 ;;
  esac
}
# Versions do not tell one build from another; the sums of the files do.
sums_of_installed() { cat "$(dpkg-query --control-path "$1" md5sums)"; }
is_installed_from() {
  is_installed "$1" && [ -e "$2" ] && [ "$(dpkg-deb --info "$2" md5sums)" = "$(sums_of_installed "$1")" ]
}

# ---- The service

stop_quietly() { systemctl stop tactusd 2>/dev/null; }

# apt has started the service with the images that were there; it is started anew with those that are.
start_service() {
  systemctl daemon-reload
  stop_quietly
  systemctl reset-failed tactusd 2>/dev/null
  systemctl --no-block start tactusd
}

restarts() { systemctl show --property NRestarts --value tactusd; }

# The service is of Type=notify: it is active once its loop ticks. It must stay so for two seconds.
is_active() {
  left=$((2 * timeout))
  while [ "$left" -gt 0 ]; do
    if systemctl --quiet is-active tactusd; then
      before="$(restarts)"
      sleep 2
      if systemctl --quiet is-active tactusd && [ "$(restarts)" = "$before" ]; then return 0; fi
    fi
    sleep 0.5
    left=$((left - 1))
  done
  return 1
}

# ---- What is put back if a step fails

save() {
  rm -rf "$pending.new"
  mkdir -p "$pending.new/packages" "$pending.new/sums" "$pending.new/files" || fail "cannot write $pending.new"
  for package in $packages; do
    is_installed "$package" || continue
    sums_of_installed "$package" >"$pending.new/sums/$package" || fail "cannot write $pending.new"
    if is_installed_from "$package" "$kept/$package.deb"; then
      cp "$kept/$package.deb" "$pending.new/packages/" || fail "cannot copy $kept/$package.deb"
    fi
  done
  if [ -d "$etc" ]; then : >"$pending.new/had_etc"; fi
  for file in $images $settings; do
    [ ! -e "$etc/$file" ] || cp -p "$etc/$file" "$pending.new/files/" || fail "cannot copy $etc/$file"
  done
  systemctl is-active tactusd >"$pending.new/service"
  sync
  mv "$pending.new" "$pending" || fail "cannot rename $pending.new"
}

is_as_before() {
  if [ -e "$pending/sums/$1" ]; then
    is_installed "$1" && [ "$(sums_of_installed "$1")" = "$(cat "$pending/sums/$1")" ]
  else
    ! is_installed "$1" && ! is_half_installed "$1"
  fi
}

# Packages that are as before are left alone, so that nothing is written on a full disk.
put_back_packages() {
  for package in $packages; do
    if ! is_as_before "$package" && [ ! -e "$pending/sums/$package" ]; then
      dpkg --purge "$package" 9>&- || say "cannot remove $package"
    fi
  done
  set --
  for package in $packages; do
    if ! is_as_before "$package" && [ -e "$pending/packages/$package.deb" ]; then
      set -- "$@" "$pending/packages/$package.deb"
    fi
  done
  [ $# -eq 0 ] || dpkg --force-confold --install "$@" 9>&- || say "cannot install $*"
  whole=0
  for package in $packages; do
    if ! is_as_before "$package"; then
      say "$package is not as it was before"
      whole=1
    fi
  done
  return "$whole"
}

put_back_files() {
  whole=0
  for file in $images $settings; do
    if [ ! -e "$pending/files/$file" ]; then
      rm -f "$etc/$file" || whole=1
    elif ! cmp -s "$pending/files/$file" "$etc/$file"; then
      if ! { mkdir -p "$etc" && cp -p "$pending/files/$file" "$etc/$file.new" && sync "$etc/$file.new" &&
        mv "$etc/$file.new" "$etc/$file"; }; then
        whole=1
      fi
    fi
    rm -f "$etc/$file.new"
  done
  [ -e "$pending/had_etc" ] || rmdir "$etc" 2>/dev/null
  [ "$whole" = 0 ] || say "the files of $etc are not as they were before; they are in $pending/files"
  return "$whole"
}

# Leaves the service stopped, motors off, where not everything is as before.
put_back() {
  stop_quietly
  back=yes
  put_back_packages || back=''
  put_back_files || back=''
  stop_quietly
  [ -n "$back" ] || return 1
  case "$(cat "$pending/service")" in
    active)
      if ! start_service || ! is_active; then
        say "tactusd does not start again: journalctl -u tactusd"
        return 1
      fi
      ;;
    activating) start_service ;; # it was trying again and again
  esac
  rm -rf "$kept" && mv "$pending/packages" "$kept" && rm -rf "$pending"
}
