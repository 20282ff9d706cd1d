#!/usr/bin/env bash
# Builds the plugin of tidy_scope.cpp, if need be, and prints where it is.
set -euo pipefail
source="$(dirname "${BASH_SOURCE[0]}")/tidy_scope.cpp"
plugin="$PWD/build/tidy/tidy_scope.so"
if [[ ! "$plugin" -nt "$source" ]]; then
  mkdir -p "$(dirname "$plugin")"
  read -r -a flags < <(llvm-config-19 --cxxflags)
  clang++-19 "${flags[@]}" -fno-rtti -fPIC -shared "$source" -o "$plugin"
fi
echo "$plugin"
