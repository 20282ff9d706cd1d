#!/usr/bin/env bash
# tidy_unit.sh -p=BUILD [OPTION...] FILE: clang-tidy on one unit, unless it found nothing in the very same bytes before:
# the unit, all that it includes, its command line, the settings and the tool. What was found clean is remembered in
# $XDG_CACHE_HOME/tactus-tidy.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

build="${1#-p=}"
file="${!#}"
remembered="${XDG_CACHE_HOME:-$HOME/.cache}/tactus-tidy"

command="$(awk -v file="  \"file\": \"$file\"" '/^  "command": / { command = $0 } index($0, file) == 1 { print command; exit }' \
  "$build/compile_commands.json" | sed -e 's/^  "command": "//; s/",$//; s/\\"/"/g; s/\\\\/\\/g')"
if [[ -z "$command" ]]; then
  echo "tests/checks/tidy_unit.sh: $build/compile_commands.json does not name $file" >&2
  exit 1
fi

# The files that the unit is made of, as a makefile's rule.
rule="$(cd "$build" && eval "clang++-19 -w -M ${command#* }" -o /dev/stdout)"
mapfile -t files < <(tr -d '\134' <<<"${rule#*:}" | tr -s ' \n' '\n' | grep .)
key="$(
  {
    clang-tidy-19 --version
    cat "$here/tidy_scope.cpp"
    printf '%s\n' "$command" "${files[@]}" | sed "s|$PWD/||g"
    find . "$build" -maxdepth 1 -name .clang-tidy -exec cat {} +
    git ls-files -z '*/.clang-tidy' | xargs -0 cat
    (cd "$build" && cat "${files[@]}")
  } | sha256sum | cut -d ' ' -f 1
)"
if [[ -f "$remembered/$key" ]]; then
  exit 0
fi
# Other units are read beside this one: what is found is printed at once.
output="$("$here/clang_tidy.sh" "$@" 2>&1)" || { echo "$output" && exit 1; }
mkdir -p "$remembered"
touch "$remembered/$key"
