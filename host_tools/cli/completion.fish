# Completion of `tactus` in fish. The program itself says what may follow; where it says nothing, files do.
function __tactus_offered
  set -l words (commandline --tokenize --cut-at-cursor --current-process)
  set -l word (commandline --current-token --cut-at-cursor)
  tactus complete $words[2..] "$word" 2>/dev/null
end
complete --command tactus --no-files --condition 'test -n "$(__tactus_offered)"' --arguments '(__tactus_offered)'
