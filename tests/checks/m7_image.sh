#!/usr/bin/env bash
# The program of the board mps2_an500 runs in QEMU with the hashes of this machine. Its size, its times and its stack are those of the
# figures that are kept, within 2 %, and what its stacks can need by its call graph has room in them. Each planted fault takes the motors' power first, and then is told with its code. A host at the
# other end of the UART gets ticks, answers and an image; its stop and its silence take the power.
# TACTUS_RENEW_GOLDEN=1 writes the figures anew. Ends with 1 if the program does anything else, and with 2 if it cannot be built or run.
set -euo pipefail
ticks=100000
figures=tests/reference/mps2_an500_figures.csv
board=firmware/mps2_an500/run.sh program=build/cortex-m7/bin/mps2_an500 images=build/cortex-m7/images
work="$(mktemp -d)" running=""
end() {
  if [[ -n "$running" ]]; then kill "$running" 2>/dev/null || true; fi
  rm -rf "$work"
}
trap end EXIT

if ! command -v qemu-system-arm >/dev/null; then
  echo "m7_image: there is no qemu-system-arm: toolchains/install-packages.sh cortex-m7" >&2
  exit 2
fi
tests/checks/build.sh release bare_metal_reference line_check || exit 2
"$board" --build || exit 2

passed=0 failed=0
# verdict NAME RESULT: counts a check and prints its line.
verdict() {
  if [[ "$2" == 0 ]]; then
    passed=$((passed + 1)) && echo "as it should be: $1"
  else
    failed=$((failed + 1)) && echo "FAILS: $1"
  fi
}

# is_same EXPECTED FOUND: compares two files, and shows the first line that differs.
is_same() {
  awk '
    NR == FNR { expected[++lines] = $0; next }
    FNR > lines || $0 != expected[FNR] { exit }
    { ++alike }
    END {
      if (alike == lines && FNR == lines) exit 0
      printf "  line %d should be: %s\n", alike + 1, alike < lines ? expected[alike + 1] : "(no line)"
      printf "  line %d is:        %s\n", alike + 1, alike < FNR ? $0 : "(no line)"
      exit 1
    }' "$1" "$2"
}

# The lines that both programs tell.
shared_lines() { grep -E '^(device|tick|fault|stop)' "$1" || true; }

# The run, tick line for tick line.
build/release/bin/bare_metal_reference "$images/device.tactus" "$images/scene.tactus" "$ticks" >"$work/here"
result=0
"$board" --ticks "$ticks" >"$work/board" || result=1
tail -n 2 "$work/board"
is_same <(shared_lines "$work/here") <(shared_lines "$work/board") || result=1
# Two runs that touch nothing are alike, too.
grep -q "^tick .* mode active touch face " "$work/board" && grep -q "^tick $ticks " "$work/board" || result=1
verdict "$ticks ticks have the hashes of this machine" "$result"

# bytes SECTION...: the size of sections of the program.
bytes() { arm-none-eabi-size -A "$program" | awk -v names=" $* " 'index(names, " " $1 " ") { sum += $2 } END { print sum + 0 }'; }
# told WORD: the number behind a word of the last line "load".
told() { grep '^load ' "$work/board" | tail -n 1 | awk -v word="$1" '{ for (i = 1; i < NF; ++i) if ($i == word) print $(i + 1) }'; }
# What the stacks can need: the program's by its call graph, the handlers' by those of all handlers at once. An exception puts up to 108
# bytes on the interrupted stack.
exception_frame=108
handlers=(tick_handler receive_handler send_handler fault_found)
toolchains/stack_bound.py "$program" --calls firmware/mps2_an500/stack_calls.txt --entry start_program "${handlers[@]/#/--entry=}" >"$work/stacks" ||
  echo "the stacks have no bound that is known"
# bound NAME...: the bytes that these functions can need together, each with an exception on top.
bound() {
  awk -v names=" $* " -v frame="$exception_frame" '
    /^stack_bound_bytes / && index(names, " " $2 " ") { sum += $3 + frame }
    END { print sum }' "$work/stacks"
}
# address NAME: the address of a symbol of the program.
address() { echo $((16#$(arm-none-eabi-nm "$program" | awk -v name="$1" '$3 == name { print $1 }'))); }
current_figures() {
  echo "figure,value"
  echo "# GCC $(arm-none-eabi-g++ -dumpfullversion), $(qemu-system-arm --version | sed -n '1s/.*version \([^ ]*\).*/QEMU \1/p'), $ticks ticks; $(date -u +%F)"
  echo "flash_bytes,$(bytes .vectors .text .rodata .init_array .ARM.exidx .data)"
  echo "images_bytes,$(bytes .device_image .scene_image)"
  echo "ram_bytes,$(bytes .stacks .data .bss)"
  echo "worst_tick_ns,$(told worst_ns)"
  echo "p999_tick_ns,$(told p99.9_ns)"
  echo "missed_ticks,$(told missed)"
  echo "stack_bytes,$(told stack_bytes)"
  echo "stack_bound_bytes,$(bound start_program)"
  echo "handler_stack_bound_bytes,$(bound "${handlers[@]}")"
}
current_figures >"$work/figures"
if [[ -n "${TACTUS_RENEW_GOLDEN:-}" ]]; then cp "$work/figures" "$figures"; fi
# A figure that became better by more is to be kept, too; otherwise it could become worse again unseen.
result=0
awk -F, -v file="$figures" '
  NR == FNR { if (!/^#/) kept[$1] = $2; next }
  /^#/ || $1 == "figure" { next }
  !($1 in kept) { printf "  %s has no %s\n", file, $1; bad = 1; next }
  $2 == "" { printf "  the program tells no %s\n", $1; bad = 1; next }
  { printf "%s %s, kept %s\n", $1, $2, kept[$1]; change = $2 - kept[$1] }
  change > 0.02 * kept[$1] || -change > 0.02 * kept[$1] {
    printf "  %s was %s and is %s; if the change is wanted: TACTUS_RENEW_GOLDEN=1 bash tests/checks/m7_image.sh\n", $1, kept[$1], $2
    bad = 1
  }
  END { exit bad }' "$figures" "$work/figures" || result=1
verdict "the figures are within 2 % of $figures" "$result"

# room NAME USED BEGIN END: a stack has room for a bound.
room() {
  local bytes=$(($(address "$4") - $(address "$3"))) result=0
  if [[ -z "$2" || "$2" -gt "$bytes" ]]; then result=1; fi
  verdict "the $1 stack of $bytes bytes has room for ${2:-unknown}" "$result"
}
room "program's" "$(bound start_program)" stack_begin stack_end
room "handlers'" "$(bound "${handlers[@]}")" stack_end handler_stack_end
result=0
if [[ "$(told stack_bytes)" -gt "$(bound start_program)" ]]; then result=1; fi
verdict "the run used $(told stack_bytes) bytes of the stack, no more than the bound" "$result"

# 400,000 instructions of 2 ns each.
budget_ns=800000
worst_ns="$(told worst_ns)"
result=0
if [[ -z "$worst_ns" || "$worst_ns" -gt "$budget_ns" ]]; then result=1; fi
verdict "the longest tick, ${worst_ns:-unknown} ns, is within its budget of $budget_ns ns" "$result"

# Prints what happened in QEMU's trace, in the order of time: restarts, exceptions but for those of the tick and the UART, changes of the motors' power, and
# a line of text where its first character is sent. Left out are the lines of ticks before a fault, and exceptions after a stop, where
# the watchdog may come once more.
story() {
  awk '
    function value(digits,  i, sum) {
      for (i = 1; i <= length(digits); ++i) sum = 16 * sum + index("0123456789abcdef", substr(digits, i, 1)) - 1
      return sum
    }
    function event(what) { events[++count] = what }
    /^Loaded reset SP 0x2/ { event("restart"); power = "" }
    /taking pending .* exception/ && $NF < 15 && !is_stopped { event("exception " $NF) }
    /^mps2_fpgaio_write .* offset 0x0 / {
      now = / data 0x0 / ? "power off" : "power on"
      if (now != power) event(now)
      power = now
    }
    /^cmsdk_apb_uart_tx / {
      match($0, /0x[0-9a-f]+/)
      code = value(substr($0, RSTART + 2, RLENGTH - 2))
      if (code == 0) next # what ends a frame
      if (!is_inside) { event(""); line = count; is_inside = 1 }
      if (code == 10) { is_inside = 0 } else if (code != 13) { events[line] = events[line] sprintf("%c", code) }
      if (events[line] ~ /^stop /) is_stopped = 1
    }
    END { for (i = 1; i <= count; ++i) print events[i] }' "$1" |
    grep -v -E '^(load|device) |^tick .* mode (init|homing|ready|active) ' |
    sed -E 's/^(tick [0-9]+) .* (mode fault) .*/\1 \2/; s/ at [0-9a-f]{16}/ at ADDRESS/; /^stopped before:|mode fault/q'
}

# tells FAULT: the program with this planted fault does what standard input says.
tells() {
  local result=0
  cat >"$work/expected"
  : >"$work/trace"
  "$board" --fault "$1" --trace "$work/trace" >"$work/output" || result=1
  story "$work/trace" >"$work/story" || true # where the last line ends it, what writes into the pipe may have more
  is_same "$work/expected" "$work/story" || result=1
  verdict "with $1 the motors' power is taken, then the report is told" "$result"
}
begin="restart
power off
tactus on mps2_an500, profile microcontroller"

tells corrupted_image <<END
$begin
stop 9 scene_image: checksum does not match, bits have changed; copy it again or bake the scene again
$begin
stopped before: 9 scene_image; the motors stay off until the power is cycled
END
tells stack_overflow <<END
$begin
power on
exception 4
power off
stop 2 stack_overflow
$begin
stopped before: 2 stack_overflow; the motors stay off until the power is cycled
END
tells hung_tick <<END
$begin
power on
exception 2
power off
stop 1 watchdog at ADDRESS
$begin
stopped before: 1 watchdog at ADDRESS; the motors stay off until the power is cycled
END
tells nan_sample <<END
$begin
power on
power off
fault 1 joint_not_finite tick 3500
tick 4000 mode fault
END

# The host at the other end of the UART. start OPTION...: runs the board with its UART on the pseudo-terminal $terminal, for `stop`.
start() {
  : >"$work/errors"
  "$board" --uart pty "$@" >"$work/errors" 2>&1 &
  running=$!
  terminal=""
  while [[ -z "$terminal" ]] && kill -0 "$running" 2>/dev/null; do
    sleep 0.1
    terminal="$(sed -n 's/^char device redirected to \([^ ]*\) .*/\1/p' "$work/errors")"
  done
}
stop() {
  kill "$running" 2>/dev/null || true
  wait "$running" 2>/dev/null || true
  running=""
}
result=0
start
build/release/bin/line_check talk "$terminal" "$images/device.tactus" "$images/scene.tactus" || result=1
stop
verdict "a host gets ticks, answers and an image, and its stop and its silence take the force" "$result"

# power_at_line BEGIN: the motors' power when the first line that begins so is sent, by QEMU's trace.
power_at_line() {
  awk -v begin="$1" '
    function value(digits,  i, sum) {
      for (i = 1; i <= length(digits); ++i) sum = 16 * sum + index("0123456789abcdef", substr(digits, i, 1)) - 1
      return sum
    }
    /^mps2_fpgaio_write .* offset 0x0 / { power = / data 0x0 / ? "off" : "on"; if (power == "on") was_on = 1 }
    /^cmsdk_apb_uart_tx / {
      match($0, /0x[0-9a-f]+/)
      code = value(substr($0, RSTART + 2, RLENGTH - 2))
      if (code == 10 || code == 0) { line = ""; next }
      line = line sprintf("%c", code)
      if (line == begin) { print was_on ? power : "never on"; exit }
    }' "$work/trace"
}

# A host that supervises the active board, and goes: nobody is there to hear the line, but QEMU's trace has it.
: >"$work/trace"
result=0
start --trace "$work/trace"
build/release/bin/line_check leave "$terminal" || result=1
power=""
for _ in {1..100}; do
  power="$(power_at_line "fault 46 line_lost ")"
  if [[ -n "$power" ]]; then break; fi
  sleep 0.2
done
stop
echo "when the lost line is told, the motors' power is ${power:-unknown}"
[[ "$power" == off ]] || result=1
verdict "a host that has gone takes the motors' power, then the report is told" "$result"

echo "$passed $failed 0" >"${TACTUS_COUNTS:-/dev/null}"
[[ "$failed" -eq 0 ]]
