#!/usr/bin/env bash
# Bakes every OFF, STL, PLY and OBJ file of some Debian packages, and ends with 0 if none is silent: each triangle that
# a file declares is in the image or told of, and each closed mesh that is inside out is told of. The oracle is
# count_mesh.py, which shares nothing with our readers. It is run by hand, downloads 110 MB and takes minutes:
#   tests/checks/real_meshes.sh [TACTUS]
# Nothing is installed. build/real-meshes/ keeps the packages, and the findings in report.tsv.
set -euo pipefail
tactus="${1:-build/release/bin/tactus}"
packages=(libcgal-demo assimp-testmodels cura geomview gmsh-doc libsimbody-dev netgen-doc openscad prusa-slicer structure-synth)
folder=build/real-meshes
mkdir -p "$folder"

# Unpacks a package, and the archives and compressed meshes in it.
unpack() {
  local files="$folder/$1" archive
  if [[ -d "$files" ]]; then return; fi
  rm -rf "$files.part" && mkdir -p "$files.part"
  (cd "$files.part" && apt-get download -qq "$1")
  dpkg-deb -x "$files.part"/*.deb "$files.part" && rm "$files.part"/*.deb
  while read -r -d '' archive; do
    tar --extract --gzip --file "$archive" --directory "$(dirname "$archive")"
  done < <(find "$files.part" -type f -name data.tar.gz -print0)
  find "$files.part" -type f -regextype posix-extended -iregex '.*\.(off|stl|ply|obj)\.gz' -exec gunzip {} +
  mv "$files.part" "$files"
}

for package in "${packages[@]}"; do unpack "$package"; done
status=0
find "$folder" -type f -regextype posix-extended -iregex '.*\.(off|stl|ply|obj)' -print0 | sort -z |
  xargs -0 python3 tests/checks/real_meshes.py "$tactus" >"$folder/report.tsv" || status=1
cut -f1 "$folder/report.tsv" | sort | uniq -c
grep ^SILENT "$folder/report.tsv" || true
exit "$status"
