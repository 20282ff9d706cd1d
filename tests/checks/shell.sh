#!/usr/bin/env bash
# The scripts have nothing that shellcheck would find.
set -euo pipefail
source tests/checks/tracked_files.sh
tracked_files '*.sh' '*.bash' .ci/run host_tools/rig/init | xargs -d '\n' shellcheck --external-sources
