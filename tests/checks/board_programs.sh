#!/usr/bin/env bash
# board_programs.sh PRESET ARCHITECTURE EMULATOR: the programs that a cross build made for a board start, bake the bunny, and touch it
# alike in every bit with those of this machine's release build.
set -euo pipefail
preset="$1" sysroot="build/sysroot/$2" emulator="$3"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

fail() { echo "board programs: $*" >&2 && exit 1; }

on_board() { "$emulator" -L "$sysroot" "build/$preset/bin/$1" "${@:2}"; }
here() { "build/release/bin/$1" "${@:2}"; }

# run HOW FOLDER: bakes, touches and simulates, by the programs of one of the two.
run() {
  local how="$1" folder="$2"
  mkdir "$folder"
  cp host_tools/examples/bunny/scene.toml "$folder"
  ln -s "$work/bunny00.off" "$folder/bunny00.off"
  "$how" tactus bake "$folder/scene.toml" -o "$folder/scene.tactus" >"$folder/bake.txt"
  "$how" tactus touch "$folder/scene.tactus" --path host_tools/examples/bunny/wish.csv --rate 1000 --output "$folder/touch.csv" \
    >"$folder/touch.txt"
  "$how" tactus sim "$folder/scene.tactus" --path host_tools/examples/bunny/wish.csv --seconds 5 --output "$folder/sim.csv" \
    --hashes "$folder/sim.hashes" >"$folder/sim.txt"
}

for program in tactus tactusd; do
  version="$(on_board $program --version)" || fail "$program does not start"
  [[ "$version" == "$(here $program --version)" && "$version" == "$program "* ]] || fail "$program --version says '$version'"
  on_board $program --help >"$work/help"
  grep -q "$program" "$work/help" || fail "$program --help does not name it"
done

host_tools/bunny_mesh.sh "$work/bunny00.off"
run here "$work/here"
run on_board "$work/board"
for file in scene.tactus touch.csv sim.csv sim.hashes; do
  cmp "$work/here/$file" "$work/board/$file" || fail "$file differs"
  echo "$file: $(wc -c <"$work/here/$file") bytes are alike"
done
