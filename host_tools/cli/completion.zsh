#compdef tactus
# Completion of `tactus` in zsh. The program itself says what may follow; where it says nothing, files do.
local -a offered
offered=("${(@f)$("${words[1]}" complete "${(@)words[2,CURRENT]}" 2>/dev/null)}")
if [[ -n "${offered[*]}" ]]; then
  compadd -a offered
else
  _files
fi
