#!/usr/bin/env bash
# Installs the Debian packages of one or more groups of toolchains/packages.txt.
#   toolchains/install-packages.sh demo tests
#   toolchains/install-packages.sh --list board     prints the names, and installs nothing
# Does nothing where all are there; else needs root or sudo. A package marked /backports comes from bookworm-backports, which
# is asked for this installation only where the machine does not list it; on another release than bookworm it is the release's own.
set -euo pipefail

list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"

groups() { sed -n 's/^\[\(.*\)\].*/\1/p' "$list"; }

# Prints the packages of a group, and of those that stand behind its name.
packages_of() {
  local line others other current=
  sed -e 's/#.*//' -e 's/[[:space:]]*$//' "$list" |
    while read -r line others; do
      case "$line" in
        "") ;;
        \[*\])
          current="$line"
          for other in $others; do
            if [[ "$current" == "[$1]" ]]; then packages_of "${other#+}"; fi
          done
          ;;
        *) if [[ "$current" == "[$1]" ]]; then echo "$line"; fi ;;
      esac
    done
}

codename="$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)"

is_installed() {
  local state
  state="$(dpkg-query -W -f='${db:Status-Abbrev} ${Version}' "${1%/backports}" 2>/dev/null)" || return 1
  [[ "$state" == ii* && ("$1" != */backports || "$state" == *bpo12*) ]]
}

as_root() {
  if [[ $EUID -eq 0 ]]; then
    "$@"
  elif [[ -t 0 ]]; then
    sudo "$@"
  else
    sudo --non-interactive "$@"
  fi
}

# Documentation folders hold the demo's mesh; slim images leave them out unless told otherwise.
apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dir::Etc::SourceParts="$sources" \
    -o Dpkg::Use-Pty=0 -o Dpkg::Options::="--path-include=/usr/share/doc/libcgal-*/*" "$@" </dev/null
}

# Prints a folder of apt sources: this machine's, and bookworm-backports from the same place if it is not among them.
sources_with_backports() {
  local folder uri key
  folder="$(mktemp -d)"
  chmod 755 "$folder"
  cp /etc/apt/sources.list.d/* "$folder" 2>/dev/null || true
  # shellcheck disable=SC2016  # apt fills it in
  uri="$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' | head -n 1)"
  key=/usr/share/keyrings/debian-archive-keyring.gpg
  echo "deb [signed-by=$key] $uri bookworm-backports main" >"$folder/tactus-backports.list"
  echo "$folder"
}

install_packages() { apt_get update && apt_get install --yes --no-install-recommends "${@/%\/backports/\/bookworm-backports}"; }

if [[ $# -eq 0 || "$1" == "--help" ]]; then
  echo "usage: ${BASH_SOURCE[0]} [--list] GROUP..."
  echo "groups: $(groups | paste -sd' ')"
  exit $(($# == 0 ? 2 : 0))
fi

wanted=install
if [[ "$1" == --list ]]; then
  wanted=list
  shift
fi
missing=()
for group in "$@"; do
  if ! groups | grep -qxF -- "$group"; then
    echo "install-packages: no group '$group' in $list; there are: $(groups | paste -sd' ')" >&2
    exit 2
  fi
  for package in $(packages_of "$group"); do
    if [[ "$wanted" == list ]]; then
      echo "$package"
      continue
    fi
    if [[ "$codename" != bookworm ]]; then package="${package%/backports}"; fi
    is_installed "$package" || missing+=("$package")
  done
done

if [[ "$wanted" == list ]]; then exit 0; fi
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "packages for $*: all installed"
  exit 0
fi
if [[ $EUID -ne 0 ]] && ! command -v sudo >/dev/null; then
  echo "install-packages: needs root or sudo to install: ${missing[*]}" >&2
  exit 1
fi

sources=/etc/apt/sources.list.d
if [[ " ${missing[*]}" == */backports* ]]; then
  sources="$(sources_with_backports)"
  trap 'rm -r "$sources"' EXIT
fi
echo "packages for $*: installing ${missing[*]}"
if ! install_packages "${missing[@]}"; then
  echo "install-packages: apt-get failed; once more" >&2
  install_packages "${missing[@]}"
fi
