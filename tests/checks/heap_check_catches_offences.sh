#!/usr/bin/env bash
# Shows that toolchains/check_no_heap.sh passes clean code and fails, naming object and symbol, on each kind of offence.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# check NAME CODE: compiles CODE for the Cortex-M7 into libNAME.a and runs the check on it.
check() {
  echo "$2" >"$work/$1.cpp"
  arm-none-eabi-g++ -std=c++23 -mcpu=cortex-m7 -mthumb -O2 "${3:--fno-exceptions}" -c "$work/$1.cpp" -o "$work/$1.o"
  arm-none-eabi-ar rcs "$work/lib$1.a" "$work/$1.o"
  toolchains/check_no_heap.sh arm-none-eabi-nm "$work/lib$1.a" >"$work/output" 2>&1
}

expect_caught() {
  if check "$@"; then
    echo "not caught: $2"
    exit 1
  fi
  if ! grep -q "$1.o refers to " "$work/output"; then
    echo "caught without naming the object: $(cat "$work/output")"
    exit 1
  fi
  cat "$work/output"
}

check clean 'double twice(double x) { return 2 * x; }'
expect_caught new 'int* f() { return new int; }'
expect_caught delete 'void f(int* p) { delete[] p; }'
expect_caught malloc '#include <cstdlib>
void* f() { return std::malloc(8); }'
expect_caught vector '#include <vector>
void f(std::vector<int>& v) { v.push_back(1); }'
expect_caught throw 'int f(int x) { if (x) throw x; return 0; }' -fexceptions
expect_caught at '#include <array>
int f(const std::array<int, 3>& a, unsigned i) { return a.at(i); }'
expect_caught printf '#include <cstdio>
void f(int x) { std::printf("%d", x); }'
expect_caught stderr '#include <cstdio>
void f() { std::fputs("x", stderr); }'
expect_caught iostream '#include <iostream>
void f() { std::cout << 1; }'
expect_caught assert '#include <cassert>
void f(int x) { assert(x); }'
expect_caught destructor 'struct S { ~S(); };
S s;'
