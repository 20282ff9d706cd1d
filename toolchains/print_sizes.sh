#!/usr/bin/env bash
# Prints a table of the sizes of the controller's static objects, and writes it to a file. The sizes are those of the arrays size_of_* in
# the object files of firmware/sizes, so a cross build can read them.
#   toolchains/print_sizes.sh NM PROFILE FILE OBJECT...
set -euo pipefail

if [[ $# -lt 4 ]]; then
  echo "usage: ${BASH_SOURCE[0]} NM PROFILE FILE OBJECT..." >&2
  exit 2
fi
nm="$1" profile="$2" file="$3"
shift 3

symbols="$("$nm" --print-size --radix=d "$@")"
{
  echo "static objects in profile $profile, bytes; an object is counted within the one that has it, too"
  awk '$4 ~ /^size_of_/ { name = substr($4, 9); gsub("_", " ", name); printf "%10d  %s\n", $2, name }' <<<"$symbols" |
    sort --key=1,1nr --key=2
} >"$file.new"
[[ "$(wc -l <"$file.new")" -gt 1 ]] || { echo "print_sizes: the object files have no array size_of_*: $*" >&2 && exit 1; }
mv "$file.new" "$file"
cat "$file"
