#!/usr/bin/env bash
# clang-tidy finds nothing in the programs of bare boards, which no compiler of this machine's builds reads. tidy.sh runs it, after it
# has made the headers in build/tidy.
set -euo pipefail
source tests/checks/tracked_files.sh
build=build/tidy/bare_metal
processor=(-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16)
made="$PWD/build/tidy/rendering"

# The folders of the cross compiler's libraries: clang has its own in place of GCC's.
system_folders="$(arm-none-eabi-g++ "${processor[@]}" -mfloat-abi=hard -E -x c++ -v /dev/null 2>&1 |
  sed -n '/^#include </,/^End/s|^ \(/.*\)|-isystem \1|p' | grep -v -E '/gcc/arm-none-eabi/[0-9.]+/include(-fixed)?$' | paste -sd' ')"
command="clang++-19 --target=thumbv7em-none-eabihf ${processor[*]} -std=c++23 -fno-exceptions -fno-rtti -DEIGEN_DONT_VECTORIZE -nostdlibinc \
-I$PWD -isystem /usr/include/eigen3 -I$made/generated -isystem $made/scene/generated -isystem $made/scene/third_party $system_folders"

mkdir -p "$build"
mapfile -t files < <(tracked_files 'firmware/mps2_an500/*.cpp' tests/bare_metal/planted_fault_main.cpp)
{
  for file in "${files[@]}"; do
    printf '{\n  "directory": "%s",\n  "command": "%s -o unit.o -c %s",\n  "file": "%s"\n},\n' "$PWD/$build" "$command" "$PWD/$file" "$PWD/$file"
  done | sed '1s/^/[\n/; $s/,$/\n]/'
} >"$build/compile_commands.json"
printf '%s\n' "${files[@]/#/$PWD/}" | xargs -d '\n' -n 1 -P "$(nproc)" tests/checks/tidy_unit.sh "-p=$build" -quiet
