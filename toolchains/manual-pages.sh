#!/usr/bin/env bash
# Writes the manual pages of a program and of each of its verbs from what --help prints. See --help.
set -euo pipefail

usage() {
  cat <<END
usage: toolchains/manual-pages.sh FOLDER SECTION [EMULATOR...] PROGRAM
Writes FOLDER/PROGRAM.SECTION, and FOLDER/PROGRAM-VERB.SECTION for each verb that the program lists. EMULATOR: what runs a program of
another processor, such as qemu-aarch64-static -L SYSROOT.
Example:
  toolchains/manual-pages.sh build/man 1 build/release/bin/tactus && man -l build/man/tactus-bake.1
END
}

# Prints the part of a help text that has usage, options and verbs (head), or the texts between them and the examples (notes), or the
# rest (examples).
part() {
  awk -v part="$1" -v RS= '
    function kind() {
      if (now == "examples" || /^Examples/) return "examples"
      if (NR == 1 || /^(Positionals|Options|Subcommands):\n/ || /^  -/) return "head"
      return "notes"
    }
    { now = kind() }
    NR == 1 { sub(/^usage:/, "Usage:") }
    /^  -/ { $0 = "Options:\n" $0 }
    now == part { print (shown++ ? "\n" : "") $0 }'
}

# Prints the text of standard input as it stands, as a section of a manual page. Its tables and its lines of code keep their columns.
verbatim() {
  local text
  text="$(cat)"
  if [[ -n "$text" ]]; then
    printf '[%s]\n.EX\n' "$1"
    sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\&&/" <<<"$text"
    echo .EE
  fi
}

# Prints the section that names the pages of the verbs on standard input, which are below the verb of the arguments, and the page above.
see_also() {
  local above=("$program" "$@") verb pages=()
  if [[ $# -gt 0 ]]; then pages+=("$(IFS=- && echo "${above[*]:0:$#}")"); fi
  while read -r verb; do
    if [[ -n "$verb" ]]; then pages+=("$(IFS=- && echo "${above[*]}-$verb")"); fi
  done
  if [[ ${#pages[@]} -gt 0 ]]; then
    printf '[SEE ALSO]\n'
    printf '%s\n' "${pages[@]//-/\\-}" | sed -e "s/.*/.BR & ($section),/" -e '$s/,$//'
  fi
}

# Writes the page of `PROGRAM VERB...`, then those of the verbs below it. help2man takes the page's name from the name of what it runs.
page() {
  local name help verbs verb
  name="$(IFS=- && echo "$program${*:+-}$*")"
  help="$("${run[@]}" "$@" --help)"
  part head <<<"$help" >"$work/$name.help"
  verbs="$(sed -n '/^Subcommands:$/,/^$/s/^  \([a-z0-9_-]*\)  .*/\1/p' "$work/$name.help")"
  {
    part notes <<<"$help" | verbatim NOTES
    part examples <<<"$help" | sed '1{/^Examples:$/d}' | verbatim EXAMPLES
    see_also "$@" <<<"$verbs"
  } >"$work/$name.include"
  printf '#!/bin/sh\ncat "%s"\n' "$work/$name.help" >"$work/$name"
  chmod +x "$work/$name"
  help2man --no-info --section="$section" --manual=Tactus --source="$version" --version-string="$version" \
    --name="$(description "$work/$name.help")" --include="$work/$name.include" "$work/$name" |
    sed -e "s/^\.TH [^ ]*/.TH ${name^^}/" -e "/^\.SH NAME/{n;s/^[^ ]*/${name//-/\\\\-}/}" >"$folder/$name.$section"
  for verb in $verbs; do page "$@" "$verb"; done
}

# Prints the first sentence beside the usage, without its full stop.
description() {
  awk '/^$/ || (/^Usage:/ && NR > 1) { exit } NR > 1 || !/^Usage:/ { text = text (text == "" ? "" : " ") $0 }
    END { sub(/\.( .*)?$/, "", text); print text }' "$1"
}

if [[ "${1:-}" == --help ]]; then usage && exit 0; fi
if [[ $# -lt 3 ]]; then usage >&2 && exit 2; fi
folder="$1" section="$2"
shift 2
run=("$@")
program="$(basename "${!#}")"
version="$("${run[@]}" --version)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"
page
