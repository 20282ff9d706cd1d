#!/usr/bin/env bash
# shellcheck finds nothing in the scripts.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/tracked_files.sh"
tracked_files '*.sh' .ci/run | xargs -d '\n' shellcheck --external-sources
