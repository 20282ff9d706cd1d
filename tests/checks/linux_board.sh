#!/usr/bin/env bash
# linux_board.sh PRESET ARCHITECTURE EMULATOR [TARGET...]: cross-builds a preset, or targets of it, for a Linux board, runs its tests that
# have been built through qemu-user, and its programs.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"
preset="$1" architecture="$2" emulator="$3"
shift 3

"$here/build_and_test.sh" "$preset" "$@"
"$here/build.sh" release tactus tactusd
"$here/board_programs.sh" "$preset" "$architecture" "$emulator"
