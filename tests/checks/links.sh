#!/usr/bin/env bash
# Every link in a README to a file of the repository leads somewhere.
set -euo pipefail
source tests/checks/tracked_files.sh
status=0

while read -r page; do
  while read -r link; do
    target="${link%%#*}"
    if [[ -n "$target" && "$target" != *:* && ! -e "$(dirname "$page")/$target" ]]; then
      echo "$page: there is no $target"
      status=1
    fi
  done < <(grep -oE '\]\([^)[:space:]]+\)' "$page" | sed -e 's/^](//' -e 's/)$//')
done < <(tracked_files '*.md')
exit "$status"
