#!/usr/bin/env bash
# Every C++ file is laid out as .clang-format says. To mend: clang-format-19 -i FILE...
set -euo pipefail
source tests/checks/tracked_files.sh
tracked_files '*.h' '*.cpp' | xargs -d '\n' clang-format-19 --dry-run -Werror
