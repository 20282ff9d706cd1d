#!/usr/bin/env bash
# clang-tidy finds nothing, neither in a translation unit nor in what it includes. Many files are read together, where the
# headers they share are looked at once; the files that bring them together lie in the build folder, and so do copies of
# the settings.
set -euo pipefail

source tests/checks/tracked_files.sh

"$(dirname "${BASH_SOURCE[0]}")/build.sh" tidy tactus_scene_header tactus_device_header tactus_telemetry_headers
tracked_files '*/.clang-tidy' | while read -r settings; do
  cp "$settings" "build/tidy/$settings"
done
printf 'InheritParentConfig: true\nChecks: -bugprone-suspicious-include\n' >build/tidy/.clang-tidy

# Prints the units, the longest first: one that began last would keep the other processors waiting.
units() {
  local unit
  sed -n 's/^  "file": "\(.*\)",\?$/\1/p' build/tidy/compile_commands.json |
    grep -E "^$PWD/((rendering|hal|drivers|firmware|host_tools|tests)/|build/tidy/.*/Unity/)" | sort -u | while read -r unit; do
    echo "$(sed -n 's/^#include "\(.*\.cpp\)"$/\1/p' "$unit" | xargs cat "$unit" | wc -c) $unit"
  done | sort -rn | cut -d ' ' -f 2-
}

units | xargs -d '\n' -n 1 -P "$(nproc)" tests/checks/tidy_unit.sh -p=build/tidy -quiet
tests/checks/tidy_bare_metal.sh
