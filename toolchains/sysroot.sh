#!/usr/bin/env bash
# Makes a folder with the Debian 12 libraries of another processor, from which a cross build takes headers and libraries. It installs
# nothing on this machine and needs no root: apt works in a folder of its own, with the mirrors of this machine's sources.
set -euo pipefail
here="$(dirname "${BASH_SOURCE[0]}")"

usage() {
  cat <<END
usage: toolchains/sysroot.sh ARCHITECTURE [FOLDER]
Makes FOLDER, or build/sysroot/ARCHITECTURE, with the libraries of the group [board] of toolchains/packages.txt.
A sysroot that is there is made anew only after a change of that list or of this script. ARCHITECTURE: arm64, armhf
Example:
  toolchains/sysroot.sh arm64 && cmake --preset aarch64 && cmake --build build/aarch64
END
}

fail() { printf 'sysroot: %s\n' "$*" >&2 && exit 1; }

# Prints the lines of an apt source list: this machine's for bookworm, and bookworm-backports from the same place.
sources() {
  # shellcheck disable=SC2016  # apt fills it in
  apt-get indextargets --format '$(RELEASE) $(REPO_URI)' 'Created-By: Packages' 'Component: main' |
    awk -v key=/usr/share/keyrings/debian-archive-keyring.gpg '
      function source(release, uri) { if (!seen[release]++) print "deb [signed-by=" key "] " uri " " release " main" }
      $1 ~ /^bookworm(-updates|-security)?$/ { source($1, $2) }
      $1 == "bookworm" { source("bookworm-backports", $2) }'
}

# Writes the apt configuration: the machine's, such as a proxy, without its hooks; states and caches are in the folder.
configure_apt() {
  local file
  mkdir -p "$work"/apt/{conf,none,state/lists/partial,cache/archives/partial}
  : >"$work/apt/state/status"
  for file in /etc/apt/apt.conf.d/*; do
    if [[ -f "$file" ]] && ! grep -q Invoke "$file"; then cp "$file" "$work/apt/conf/"; fi
  done
  cat >"$work/apt/conf/zz-sysroot" <<END
APT::Architecture "$architecture";
APT::Architectures "$architecture";
APT::Install-Recommends "false";
APT::Sandbox::User "root";
Dir::State "$work/apt/state";
Dir::State::status "$work/apt/state/status";
Dir::Cache "$work/apt/cache";
Dir::Etc::SourceList "$work/apt/sources.list";
Dir::Etc::SourceParts "$work/apt/none";
END
  echo "Dir::Etc::Parts \"$work/apt/conf\";" >"$work/apt/apt.conf"
}

apt_get() { APT_CONFIG="$work/apt/apt.conf" apt-get -qq "$@" </dev/null; }

# Fetches the packages and all that they depend on.
download() {
  echo "sysroot for $architecture: reading the lists of packages"
  apt_get -o APT::Update::Error-Mode=any update || return 1
  echo "sysroot for $architecture: downloading"
  # shellcheck disable=SC2086  # the packages are words
  apt_get install --yes --download-only ${packages//\/backports/\/bookworm-backports} >"$work/apt/log"
}

# The index of security updates of another architecture may be older than its signature: they are then left out.
download_with_or_without_security() {
  sources >"$work/apt/sources.list"
  grep -q ' bookworm main$' "$work/apt/sources.list" || fail "this machine's apt sources (/etc/apt) have no Debian bookworm"
  download && return
  echo "sysroot: once more, without the security updates" >&2
  sed -i '/ bookworm-security main$/d' "$work/apt/sources.list"
  rm -rf "$work/apt/state/lists"
  mkdir -p "$work/apt/state/lists/partial"
  download || fail "apt-get could not fetch the packages for $architecture; its messages stand above"
}

# Links and CMake's descriptions of packages that name a path from the root then name it within the folder.
keep_paths_inside() {
  local link target
  find "$work/root" -type l -lname '/*' | while read -r link; do
    target="$(readlink "$link")"
    ln -sfn "$(realpath --no-symlinks --relative-to="$(dirname "$link")" "$work/root$target")" "$link"
  done
  # shellcheck disable=SC2016  # CMake fills it in
  find "$work/root" -name '*.cmake' -exec sed -i -E 's#([";: ])/usr(["/])#\1${CMAKE_SYSROOT}/usr\2#g' {} +
}

# Keeps what dpkg-shlibdeps asks about a package: its files, and which versions of it have which symbols.
keep_record() {
  local deb="$1" records="$2" control="$work/control" package name file
  package="$(dpkg-deb --field "$deb" Package)"
  name="$package"
  if [[ "$(dpkg-deb --field "$deb" Multi-Arch)" == same ]]; then name="$package:$architecture"; fi
  dpkg-deb --control "$deb" "$control"
  { sed '/^Package:/a Status: install ok installed' "$control/control" && echo; } >>"$records/status"
  dpkg-deb --fsys-tarfile "$deb" | tar --list | sed -n 's/^\.\(.*[^/]\)$/\1/p' >"$records/info/$name.list"
  for file in symbols shlibs; do
    if [[ -f "$control/$file" ]]; then mv "$control/$file" "$records/info/$name.$file"; fi
  done
  rm -r "$control"
}

# Unpacks what was fetched, without programs and texts; var/lib/dpkg then has the records of the packages.
unpack() {
  local deb records="$work/root/var/lib/dpkg"
  echo "sysroot for $architecture: unpacking $(find "$work/apt/cache/archives" -name '*.deb' | wc -l) packages"
  mkdir "$work/root"
  for deb in "$work"/apt/cache/archives/*.deb; do dpkg -x "$deb" "$work/root"; done
  rm -rf "$work"/root/{bin,etc,sbin,var} "$work"/root/usr/{bin,sbin,src} "$work"/root/usr/share/{doc,info,lintian,locale,man}
  mkdir -p "$records/info"
  echo "$architecture" >"$records/arch"
  echo 1 >"$records/info/format"
  for deb in "$work"/apt/cache/archives/*.deb; do keep_record "$deb" "$records"; done
}

case "${1:-}" in
  --help) usage && exit 0 ;;
  arm64 | armhf) architecture="$1" ;;
  "") usage >&2 && exit 2 ;;
  *) usage >&2 && fail "Debian has no libraries for '$1' that we use; there are arm64 and armhf" ;;
esac
[[ $# -le 2 ]] || { usage >&2 && exit 2; }
folder="${2:-$here/../build/sysroot/$architecture}"
made_of="$folder/made-of"
packages="$("$here/install-packages.sh" --list board)"
wanted="$(sha256sum <"${BASH_SOURCE[0]}") $architecture"$'\n'"$packages"

if [[ -e "$folder" && ! -f "$made_of" ]]; then fail "$folder is there and is no sysroot of ours; name another folder or remove it"; fi
if [[ -f "$made_of" && "$(cat "$made_of")" == "$wanted" ]]; then
  echo "sysroot for $architecture: $folder is there"
  exit 0
fi

mkdir -p "$(dirname "$folder")"
work="$(mktemp -d "$(realpath "$(dirname "$folder")")/unfinished-sysroot.XXXXXX")"
trap 'rm -rf "$work"' EXIT
configure_apt
download_with_or_without_security
unpack
keep_paths_inside
echo "$wanted" >"$work/root/made-of"
chmod 755 "$work/root"
if [[ -e "$folder" ]]; then mv "$folder" "$work/replaced"; fi
mv "$work/root" "$folder"
echo "sysroot for $architecture: $folder, $(du -sm "$folder" | cut -f 1) MB"
