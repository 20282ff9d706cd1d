#!/usr/bin/env bash
# course.sh [TACTUS]: runs the commands of the course's README in their order and leaves the pictures in out/. TACTUS is the program; without it the
# one that host_tools/demo.sh builds.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
program="$(realpath "${1:-$here/../../../build/release/bin/tactus}")"
if [[ ! -x "$program" ]]; then
  echo "course.sh: no program $program; run host_tools/demo.sh first, or give its path" >&2
  exit 2
fi
tactus() { "$program" "$@"; }

cd "$here"
mkdir -p out
while IFS= read -r line; do
  case "$line" in
    "## "*) echo; echo "${line#\#\# }" ;;
    "tactus "*) echo "  $line"; eval "$line" ;;
  esac
done <README.md
