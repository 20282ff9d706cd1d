#!/usr/bin/env bash
# Every verb with --serial works with the program of the board mps2_an500 in QEMU: recordings replay with equal hashes, commands and stops are
# answered, the monitor operates the board, and a lost line takes the motors' power.
# Ends with 1 if anything does not, and with 2 if the program cannot be built or run.
set -euo pipefail
tactus="$PWD/build/release/bin/tactus" program=build/cortex-m7/bin/mps2_an500
work="$(mktemp -d)"
line="unix:$work/board.sock"
export XDG_CACHE_HOME="$work/cache"
emulator="" gateway=""
terminal=(tmux -S "$work/tmux" -f /dev/null)
end() {
  "${terminal[@]}" kill-server 2>/dev/null || true
  for process in $gateway $emulator; do kill "$process" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap end EXIT

for tool in qemu-system-arm tmux; do
  if ! command -v "$tool" >/dev/null; then
    echo "m7_line: there is no $tool: toolchains/install-packages.sh demo cortex-m7" >&2
    exit 2
  fi
done
firmware/mps2_an500/run.sh --build || exit 2

passed=0 failed=0
# verdict NAME RESULT: counts a check and prints its line.
verdict() {
  if [[ "$2" == 0 ]]; then
    passed=$((passed + 1)) && echo "as it should be: $1"
  else
    failed=$((failed + 1)) && echo "FAILS: $1" && tail -n 20 "$work/said" 2>/dev/null | sed 's/^/  /'
  fi
}
# says PATTERN COMMAND...: the command ends with 0, and a line of its output matches.
says() {
  local pattern="$1"
  shift
  timeout 60 "$@" >"$work/said" 2>&1 && grep -qE -- "$pattern" "$work/said"
}
# ends_with CODE PATTERN COMMAND...: the same for another exit code.
ends_with() {
  local code="$1" pattern="$2" result=0
  shift 2
  timeout 60 "$@" >"$work/said" 2>&1 || result=$?
  [[ "$result" == "$code" ]] && grep -qE -- "$pattern" "$work/said"
}
# check NAME COMMAND...: the verdict of a command.
check() {
  local name="$1" result=0
  shift
  "$@" || result=1
  verdict "$name" "$result"
}
# on_board VERB...: a verb with the line. A program, so that timeout can run it.
printf '#!/bin/sh\nexec "%s" "$@" --serial "%s"\n' "$tactus" "$line" >"$work/on_board"
chmod +x "$work/on_board"
on_board="$work/on_board"
within() { # SECONDS COMMAND...: the command comes true in time.
  local i
  for ((i = 0; i < $1 * 10; ++i)); do
    if "${@:2}"; then return 0; fi
    sleep 0.1
  done
  return 1
}

start_board() {
  "$tactus" flash "$program" --emulate --line "$work/board.sock" >"$work/emulator" 2>&1 &
  emulator=$!
  within 20 test -S "$work/board.sock"
}
stop_board() {
  kill "$emulator" && wait "$emulator"
  local result=$?
  emulator=""
  return "$result"
}

# The board starts when the line is opened: the recording has its first tick, and is operated on the way.
recorded_run() {
  "$tactus" line "$line" --run-dir "$work/run" --record "$work/run.mcap" >"$work/texts" 2>"$work/said" &
  gateway=$!
  within 20 test -S "$work/run/command.sock" || return 1
  within 60 grep -q '^tick 1000 ' "$work/texts" || return 1
  "$tactus" set max_force_N 4 --run-dir "$work/run" >>"$work/said" &&
    "$tactus" set object.0.stiffness_N_per_m 600 --run-dir "$work/run" >>"$work/said" &&
    "$tactus" disable --run-dir "$work/run" >>"$work/said" &&
    "$tactus" enable --run-dir "$work/run" >>"$work/said" &&
    within 60 grep -q '^tick 2000 ' "$work/texts" && kill "$gateway" && wait "$gateway"
  local result=$?
  gateway=""
  return "$result"
}
begins_with_tick_0() { start_board && recorded_run && grep -q 'ticks, 0 to' "$work/texts"; }
check "tactus line serves commands while it records from tick 0 on" begins_with_tick_0
replays() {
  says '^ticks 0 to [0-9]{4,} .*every hash equal$' "$tactus" replay "$work/run.mcap"
}
check "the recording replays from tick 0 with equal hashes" replays
check "the board's lines of text pass by" grep -qE '^tick [0-9]+000 hash [0-9a-f]{16} ' "$work/texts"

check "status" says '^ok status tick=[0-9]+ mode=active faults=none' "$on_board" status
check "get lists the objects by name" says 'object\.0\.stiffness_N_per_m +600 .*\(dimpled ball\)' "$on_board" get
check "get reads what set has set" says 'max_force_N=4' "$on_board" get max_force_N
check "a value out of its range is refused with 1" ends_with 1 'out of its range' "$on_board" set max_force_N 1000
check "a scene is refused with 1" ends_with 1 "part of its program" "$on_board" scene "$work/other.tactus"
# Ticks in a row, however long this machine takes for them.
watched() {
  { timeout 60 "$on_board" watch --fields tick,mode,force || true; } 2>/dev/null | head -n 500 >"$work/said"
  awk '!/^tick=[0-9]+ mode=active/ { exit 1 } { sub(/tick=/, "", $1); in_a_row += NR > 1 && $1 == last + 1; last = $1 } END { exit in_a_row < 400 }' "$work/said"
}
check "watch prints ticks in a row" watched
# The server answers as soon as the first ticks have come; a browser gets no page.
served() {
  local serving port answer result=0
  "$on_board" foxglove --port 0 2>"$work/said" &
  serving=$!
  within 20 grep -q 'ws://127.0.0.1:' "$work/said" || result=1
  port="$(sed -n 's|.*ws://127.0.0.1:\([0-9]*\),.*|\1|p' "$work/said")"
  answer="$(exec 3<>"/dev/tcp/127.0.0.1/$port" && printf 'GET / HTTP/1.1\r\nHost: localhost\r\n\r\n' >&3 && timeout 20 head -n 1 <&3)" || result=1
  kill -INT "$serving" && wait "$serving" || result=1
  [[ "$result" == 0 && "$answer" == 'HTTP/1.1 404 '* ]]
}
check "foxglove serves the board" served
check "record with --serial" says 'run2.mcap: [0-9]+ ticks, [0-9]+ to [0-9]+; no replay' "$on_board" record on "$work/run2.mcap" --seconds 1
# The Python module, where the release build has it.
python_board() {
  says '^4\.0 active [0-9]+ in a row' env PYTHONPATH="$PWD/build/release/python" /usr/bin/python3 - "$line" <<'END'
import itertools
import sys
import tactus
with tactus.connect(serial=sys.argv[1]) as board:
    force = board.get("max_force_N")
    with board.watch(["tick", "mode"], timeout_s=30) as watched:
        ticks = list(itertools.islice(watched, 200))
    in_a_row = sum(after["tick"] == before["tick"] + 1 for before, after in zip(ticks, ticks[1:]))
    assert in_a_row > 150, in_a_row
    print(force, board.status()["mode"], in_a_row, "in a row")
END
}
if compgen -G "build/release/python/tactus/_core*.so" >/dev/null; then
  check "the Python module operates and watches it" python_board
fi
check "estop" says '^ok estop tick=[0-9]+ mode=fault' "$on_board" estop
check "the stop is an operator's" says 'mode=fault faults=operator_stop' "$on_board" status
check "enable is refused in fault with 1" ends_with 1 'refused enable' "$on_board" enable
check "reset, home and enable lead back" says 'mode=active' bash -c "'$on_board' reset && '$on_board' home --wait && '$on_board' enable"

screen_has() { "${terminal[@]}" capture-pane -p | tee "$work/said" | grep -qE -- "$1"; }
monitored() {
  "${terminal[@]}" new-session -d -x 80 -y 24 "TERM=screen '$tactus' monitor --serial '$line'; echo left with \$?; sleep 60" &&
    within 20 screen_has 'tactus mps2_an500 .* ACTIVE ' && within 20 screen_has 'face of object 0|edge of object 0|vertex of object 0' &&
    "${terminal[@]}" send-keys d && within 20 screen_has ' READY ' &&
    "${terminal[@]}" send-keys Space && within 20 screen_has '^! operator_stop' &&
    "${terminal[@]}" send-keys r && within 20 screen_has '^ok reset' &&
    "${terminal[@]}" send-keys q && within 20 screen_has 'left with 0'
}
check "the monitor shows the board and operates it" monitored

# A program that dies is a lost line to the board.
lost_host() {
  says 'mode=active' bash -c "'$on_board' home --wait && '$on_board' enable" || return 1
  "$tactus" line "$line" --run-dir "$work/run" >"$work/texts" 2>"$work/said" &
  gateway=$!
  within 20 test -S "$work/run/command.sock" && sleep 0.5 && kill -KILL "$gateway" || return 1
  wait "$gateway" 2>/dev/null
  gateway=""
  # A verb would keep the line. The board's half second may take this machine some.
  sleep 8
  says 'mode=fault faults=line_lost' "$on_board" status
}
check "a host that dies makes the board stop by itself" lost_host

# An emulator that ends is a lost line to the verb.
lost_board() {
  "$on_board" watch >"$work/ticks" 2>"$work/said" &
  local watching=$! result=0
  within 30 test -s "$work/ticks" || return 1
  stop_board || return 1
  wait "$watching" || result=$?
  [[ "$result" == 2 ]] && grep -q 'the line is lost' "$work/said"
}
check "a board that is gone ends a verb with 2" lost_board
check "the emulator's socket goes with it" test ! -e "$work/board.sock"

echo "$passed $failed 0" >"${TACTUS_COUNTS:-/dev/null}"
[[ "$failed" -eq 0 ]]
