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
run-clang-tidy-19 -clang-tidy-binary "$PWD/tests/checks/tidy_unit.sh" -quiet -p build/tidy -j "$(nproc)" "^$PWD/((rendering|hal|drivers|firmware|host_tools|tests)/|build/tidy/.*/Unity/)"
