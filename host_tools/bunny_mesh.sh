#!/usr/bin/env bash
# Writes the Stanford bunny of Debian's libcgal-demo (37,706 vertices, 75,408 triangles) to FILE.
#   host_tools/bunny_mesh.sh FILE
set -euo pipefail
file="${1:?usage: bunny_mesh.sh FILE}"
archive=/usr/share/doc/libcgal-dev/data.tar.gz
mesh=data/meshes/bunny00.off

fail() { printf 'bunny_mesh.sh: %s\n' "$*" >&2 && exit 1; }

# Slim images leave documentation out when they install a package: the mesh is then taken from the package itself.
archive_from_package() (
  folder="$(mktemp -d)"
  trap 'rm -rf "$folder"' EXIT
  chmod 755 "$folder"
  cd "$folder"
  apt-get download -qq libcgal-demo >&2
  dpkg-deb --fsys-tarfile libcgal-demo_*.deb | tar --extract --to-stdout ".$archive"
)

extract_bunny() {
  if [[ -f "$archive" ]]; then
    tar --extract --gzip --to-stdout --file "$archive" "$mesh"
  else
    archive_from_package | tar --extract --gzip --to-stdout "$mesh"
  fi
}

extract_bunny >"$file.part" || fail "cannot get $mesh out of libcgal-demo"
[[ "$(sed -n 2p "$file.part")" == "37706 75408 0" ]] || fail "$mesh is not the bunny that was expected"
mv "$file.part" "$file"
