#!/usr/bin/env bash
# Installs the release build to an empty prefix; builds and runs there a project that knows only find_package(tactus), and
# reads what a Linux board gets. Then removes all that again, and nothing else.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

"$(dirname "${BASH_SOURCE[0]}")/build.sh" release
cmake --install build/release --prefix "$work/prefix"
# The headers have the sizes of the libraries.
cmp build/release/rendering/generated/rendering/profiles/chosen_profile.h \
  "$work/prefix/include/tactus/rendering/profiles/chosen_profile.h"
tests/checks/embedding.sh "$work/prefix"
tests/checks/deploy_files.sh "$work/prefix"

echo "someone's own" >"$work/prefix/include/tactus/notes.txt"
cmake --install build/release --prefix "$work/prefix" >"$work/installed"
cmake --build build/release --target uninstall
# The daemon's configuration is the administrator's from then on.
left="$(cd "$work/prefix" && find . -type f -not -path './etc/tactus/*')"
if [[ "$left" != ./include/tactus/notes.txt ]]; then
  echo "FAILS: uninstall leaves '$left', not someone's own file alone"
  exit 1
fi
if [[ -d "$work/prefix/share/tactus" ]]; then
  echo "FAILS: uninstall leaves empty folders"
  exit 1
fi
