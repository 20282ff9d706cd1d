# tracked_files PATTERN...: the files of the repository that git knows and that are there, one a line. To be sourced.
# shellcheck shell=bash
tracked_files() {
  git -c safe.directory="$PWD" ls-files --cached --others --exclude-standard -- "$@" | while read -r file; do
    if [[ -f "$file" ]]; then echo "$file"; fi
  done
}
