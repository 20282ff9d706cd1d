#!/usr/bin/env bash
# toolchains/stack_bound.py finds the bound that GCC's own frames (-fstack-usage) add up to, and refuses programs whose stack it cannot bound.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
if ! command -v arm-none-eabi-g++ >/dev/null; then
  echo "stack_bound_is_right: there is no arm-none-eabi-g++: toolchains/install-packages.sh cortex-m7" >&2
  exit 2
fi

cat >"$work/begin.h" <<'END'
extern "C" {
[[gnu::noinline]] inline int leaf(int x) { volatile int room[25]; room[x & 7] = x; return room[x & 3]; }
[[gnu::noinline]] inline int deep(int x) { volatile int room[50]; room[x & 7] = x; return leaf(room[x & 3]) + 1; }
[[gnu::noinline]] inline int cased(int x) {
  volatile int room[10]; room[x & 7] = x;
  switch (x) {
    case 0: return leaf(1) + room[0]; case 1: return deep(2) + room[1]; case 2: return leaf(3) * room[2];
    case 3: return leaf(4) - room[3]; case 4: return leaf(5) / 3 + room[4]; case 5: return leaf(6) + 7 * room[5];
    default: return room[0];
  }
}
void start_program();
}
END
failures=0
# program NAME <SOURCE: compiles and links a program, and keeps GCC's frames.
program() {
  { cat "$work/begin.h" && cat; } >"$work/$1.cpp"
  arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -O2 -fno-exceptions -fno-ipa-cp -fno-inline-functions \
    -fno-optimize-sibling-calls -fstack-usage -c "$work/$1.cpp" -o "$work/$1.o"
  arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -nostdlib -Wl,-e,start_program "$work/$1.o" -lgcc -o "$work/$1"
}
# gives NAME BYTES CALLS...: the bound of this program with these lines about calls.
gives() {
  local name="$1" expected="$2" bound
  shift 2
  printf '%s\n' "$@" >"$work/calls"
  bound="$(toolchains/stack_bound.py "$work/$name" --calls "$work/calls" | awk '/^stack_bound_bytes/ { print $3 }')" || true
  if [[ -n "$bound" && "$bound" == "$expected" ]]; then
    echo "as it should be: $name needs $bound bytes"
  else
    echo "FAILS: $name needs $expected bytes, and the bound is ${bound:-not found}"
    failures=$((failures + 1))
  fi
}
# refuses NAME REASON CALLS...: the program is refused with this reason.
refuses() {
  local name="$1" reason="$2"
  shift 2
  printf '%s\n' "$@" >"$work/calls"
  if toolchains/stack_bound.py "$work/$name" --calls "$work/calls" >"$work/output" 2>&1 || ! grep -qF "$reason" "$work/output"; then
    echo "FAILS: $name is not refused with: $reason"
    cat "$work/output"
    failures=$((failures + 1))
  else
    echo "as it should be: $name is refused: $reason"
  fi
}
# frames NAME FUNCTION...: the sum of GCC's frames of these functions.
frames() {
  awk -F'\t' -v names=" ${*:2} " '{ n = split($1, place, /[: (]+/); for (i = 1; i <= n; ++i) if (index(names, " " place[i] " ")) { sum += $2; break } } END { print sum }' \
    "$work/$1.su"
}

program chain <<'END'
void start_program() { volatile int room[5]; room[0] = cased(room[1]); while (true) {} }
END
gives chain "$(frames chain start_program cased deep leaf)"

program pointer <<'END'
using Function = int (*)(int);
Function volatile chosen;
void start_program() { chosen = deep; volatile int room[5]; room[0] = chosen(room[1]); while (true) {} }
END
gives pointer "$(frames pointer start_program deep leaf)" "start_program -> deep"
refuses pointer "not said what is called through a pointer in start_program"
refuses pointer "not said who calls deep, whose address is taken" "start_program -> leaf"
refuses pointer "there is no such function" "start_program -> deep | missing"
refuses pointer "no function that calls through a pointer is named deep" "start_program -> deep" "deep -> leaf"

program recursion <<'END'
[[gnu::noinline]] int factorial(int x) { volatile int room[9]; room[x & 7] = x; return x <= 1 ? 1 : room[x & 7] * factorial(x - 1) + room[x & 3]; }
void start_program() { volatile int room[5]; room[0] = factorial(room[1]); while (true) {} }
END
refuses recursion "calls itself, to no depth that is known"
gives recursion "$(($(frames recursion start_program) + 7 * $(frames recursion factorial)))" "recursion factorial(int) 7"
refuses recursion "no function that calls itself is named leaf" "recursion leaf 7"

program mutual <<'END'
[[gnu::noinline]] int odd(int x);
[[gnu::noinline]] int even(int x) { volatile int room[9]; room[x & 7] = x; return x == 0 ? 1 : odd(room[x & 7] - 1) + 1; }
int odd(int x) { volatile int room[9]; room[x & 7] = x; return x == 0 ? 0 : even(room[x & 7] - 1) + 1; }
void start_program() { volatile int room[5]; room[0] = even(room[1]); while (true) {} }
END
refuses mutual "these call each other, to no depth that is known"

program dynamic <<'END'
void start_program() { volatile int count = 5; volatile char* room = static_cast<char*>(__builtin_alloca(count)); room[1] = 1; leaf(room[1]); while (true) {} }
END
refuses dynamic "the stack grows by an amount that is not constant"

[[ "$failures" -eq 0 ]]
