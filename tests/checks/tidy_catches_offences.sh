#!/usr/bin/env bash
# Shows that clang-tidy, kept to the project's own code, still finds offences in a file and in what it includes, and that a
# clean one passes.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir "$work/tests"

check() {
  tests/checks/clang_tidy.sh --config-file=.clang-tidy "$work/tests/unit.cpp" -- -std=c++23 -I"$work" >"$work/output" 2>&1
}

# expect_caught CHECK HEADER_LINE SOURCE_LINE
expect_caught() {
  printf '#pragma once\n#include <utility>\n#include <vector>\nnamespace tactus {\n%s\n}  // namespace tactus\n' "$2" >"$work/tests/unit.h"
  printf '#include "tests/unit.h"\n\n#include <string>\nnamespace tactus {\n%s\n}  // namespace tactus\n' "$3" >"$work/tests/unit.cpp"
  if check || ! grep -q "\[$1," "$work/output"; then
    echo "not caught: $1"
    cat "$work/output"
    exit 1
  fi
  echo "caught: $1"
}

printf '#include <string>\nnamespace tactus {\nint size_of(const std::string& text);\nint size_of(const std::string& text) { return static_cast<int>(text.size()); }\n}  // namespace tactus\n' >"$work/tests/unit.cpp"
if ! check; then
  echo "a clean file does not pass"
  cat "$work/output"
  exit 1
fi
expect_caught modernize-use-using 'typedef std::vector<int> Numbers;' ''
expect_caught modernize-use-nullptr 'inline int* nowhere() { return 0; }' ''
expect_caught readability-identifier-naming '' 'class lower {};'
expect_caught readability-container-size-empty '' 'bool is_empty(const std::string& text) { return text.size() == 0; }'
expect_caught clang-analyzer-core.DivideZero '' 'int divide(int by) { if (by == 0) { return 1 / by; } return by; }'
expect_caught bugprone-use-after-move '' 'std::size_t twice(std::string text) { const std::string other = std::move(text); return other.size() + text.size(); }'
