# shellcheck shell=bash
# Completion of `tactus` and `tactusd` in bash. The program itself says what may follow; file names are the shell's.
_tactus() {
  local IFS=$'\n'
  mapfile -t COMPREPLY < <("${COMP_WORDS[0]}" complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -o bashdefault -o default -F _tactus tactus

# `tactusd --help` lists the options of the other program; bash-completion reads such lists.
if declare -F _longopt >/dev/null; then complete -o bashdefault -o default -F _longopt tactusd; fi
