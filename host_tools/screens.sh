#!/usr/bin/env bash
# Takes the screens of host_tools/README.md anew from the real programs: `tactus doctor` of this machine, and `tactus
# monitor` in a terminal of 80x24 beside a served simulation. Needs a built `tactus` and tmux.
#   host_tools/screens.sh [TACTUS]            writes them into host_tools/README.md
#   host_tools/screens.sh [TACTUS] --check    operates the monitor by its keys and writes nothing; for the tests
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tactus="$(realpath "${1:-build/release/bin/tactus}")"
purpose="${2:-write}"
readme=host_tools/README.md
work="$(mktemp -d)"
terminal=(tmux -S "$work/tmux" -f /dev/null)
server=""

leave() {
  "${terminal[@]}" kill-server 2>/dev/null || true
  if [[ -n "$server" ]]; then kill "$server" 2>/dev/null || true; fi
  rm -rf "$work"
}
trap leave EXIT
fail() {
  echo "host_tools/screens.sh: $*" >&2
  "${terminal[@]}" capture-pane -p >&2 2>/dev/null || true
  cat "$work/server.log" >&2 2>/dev/null || true
  exit 1
}

screen() { "${terminal[@]}" capture-pane -p; }
press() { "${terminal[@]}" send-keys "$1"; }
# Until the screen has that text, a minute at most: a machine may be busy.
wait_for() {
  local i
  for ((i = 0; i < 600; ++i)); do
    if screen 2>/dev/null | grep -qE -- "$1"; then return 0; fi
    sleep 0.1
  done
  fail "the monitor never showed: $1"
}

serve() {
  mkdir "$work/run"
  "$tactus" bake host_tools/examples/wall/scene.toml -o "$work/scene.tactus" >"$work/server.log"
  "$tactus" sim "$work/scene.tactus" --serve --run-dir "$work/run" >>"$work/server.log" 2>&1 &
  server=$!
  local i
  for ((i = 0; i < 600; ++i)); do
    if [[ -S "$work/run/telemetry.sock" && -S "$work/run/command.sock" ]]; then return 0; fi
    sleep 0.1
  done
  fail "the simulation does not serve"
}

open_monitor() {
  "${terminal[@]}" new-session -d -x 80 -y 24 "TERM=screen '$tactus' monitor --run-dir '$work/run'; echo left with \$?; sleep 60"
  wait_for 'q quit'
}

# Home and enable, by keys, then a moment in contact.
operate() {
  wait_for 'tick [0-9]'
  press h
  wait_for '^ok home'
  wait_for ' READY '
  press e
  wait_for '^ok enable'
  wait_for ' ACTIVE '
}

# Everything that a key can do, and the end of the run.
check() {
  "$tactus" watch --run-dir "$work/run" --fields tick,mode --every 10 | head -n 3 >"$work/lines" || fail "watch ends badly"
  [[ "$(grep -cE '^tick=[0-9]+ mode=[a-z]+$' "$work/lines")" -eq 3 ]] || fail "watch: $(cat "$work/lines")"
  "$tactus" watch --run-dir "$work/run" --explain --every 10 | head -n 3 >"$work/lines" || fail "watch --explain ends badly"
  [[ "$(grep -cE '^tick=[0-9]+ state=[a-z]+ .* objects_ns=[0-9]+$' "$work/lines")" -eq 3 ]] || fail "watch --explain: $(cat "$work/lines")"
  press x
  wait_for 'tick [0-9]+ explained'
  wait_for '^(face|edge|vertex) .*object 0'
  press x
  wait_for 'axes, rad or m'
  press d
  wait_for '^ok disable'
  press Space
  wait_for ' FAULT '
  wait_for '^! operator_stop'
  press e
  wait_for '^refused enable'
  press r
  wait_for '^ok reset'
  press q
  wait_for 'left with 0'
  echo "monitor: every key does what it says"
}

# Puts a file's text between the two lines of the README that name it.
insert() {  # NAME FILE
  awk -v name="$1" -v file="$2" '
    $0 == "<!-- " name " -->" { print; print "```"; while ((getline line < file) > 0) print line; print "```"; skip = 1 }
    $0 == "<!-- end of " name " -->" { skip = 0 }
    !skip && $0 != "<!-- " name " -->" { print }' "$readme" >"$work/readme"
  cp "$work/readme" "$readme"
}

serve
open_monitor
operate
if [[ "$purpose" == "--check" ]]; then
  check
  exit 0
fi
wait_for 'of object'
screen >"$work/monitor"
"$tactus" doctor host_tools/examples/devices/odrive_arm.toml >"$work/doctor" || [[ $? -eq 1 ]]
insert "tactus monitor" "$work/monitor"
insert "tactus doctor" "$work/doctor"
echo "$readme"
