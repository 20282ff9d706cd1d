#!/usr/bin/env bash
# clang_tidy.sh ARGUMENT...: clang-tidy, kept to this project's code by the plugin of tidy_scope.cpp, which is built if need be.
set -euo pipefail
source="$(dirname "${BASH_SOURCE[0]}")/tidy_scope.cpp"
plugin="$PWD/build/tidy/tidy_scope.so"
if [[ ! "$plugin" -nt "$source" ]]; then
  mkdir -p "$(dirname "$plugin")"
  read -r -a flags < <(llvm-config-19 --cxxflags)
  clang++-19 "${flags[@]}" -fno-rtti -fPIC -shared "$source" -o "$plugin.$$"
  mv "$plugin.$$" "$plugin" # whole, for those that run beside this
fi
# The temporary buffer of libstdc++ 12's std::stable_sort is deprecated, which clang holds against the one that sorts.
exec clang-tidy-19 "-load=$plugin" --checks=tactus-scope --extra-arg=-Wno-deprecated-declarations "$@"
