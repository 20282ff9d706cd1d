#!/usr/bin/env bash
# toolchains/packages.txt is the one list: each package once, with a reason; nothing else installs any. toolchains/sysroot.sh takes its
# packages from it, too, and unpacks them into a folder. The host tools tell the user how to install one, in
# host_tools/install_command.h; a screen of that is in host_tools/README.md. The packages of Tactus itself are files: ./tactus*.deb.
set -euo pipefail
source tests/checks/tracked_files.sh
list=toolchains/packages.txt
status=0

unexplained="$(grep -vE '^(#|\[|$)' "$list" | grep -vE '^[a-z0-9.+-]+(/backports)? +# .+' || true)"
if [[ -n "$unexplained" ]]; then
  echo "$list: no reason given: $unexplained"
  status=1
fi
twice="$(grep -oE '^[a-z0-9.+-]+' "$list" | sort | uniq -d)"
if [[ -n "$twice" ]]; then
  echo "$list: named twice: $twice"
  status=1
fi
unknown="$(grep -oE '^\[.*' "$list" | grep -oE '\+[a-z-]+' | tr -d + | sort -u | while read -r group; do
  grep -q "^\[$group\]" "$list" || echo "$group"
done)"
if [[ -n "$unknown" ]]; then
  echo "$list: a group takes in one that is not there: $unknown"
  status=1
fi
if tracked_files '*' | grep -vxF -e toolchains/install-packages.sh -e host_tools/install_command.h -e host_tools/README.md \
    -e "tests/checks/$(basename "$0")" |
  xargs -d '\n' grep -nE '\b(apt|apt-get|aptitude) (-[^ ]+ )*install\b|\bdpkg (-i|--install)' |
  grep -vE ' install (\./|/tmp/)[^ ]*\.deb'; then
  echo "only toolchains/install-packages.sh installs packages"
  status=1
fi
exit "$status"
