#compdef lamp
# Completes command lines of lamp in zsh, which asks lamp for the words. Those that end in '=' go on.
# SPDX-License-Identifier: Apache-2.0
_lamp() {
  local line="${(j: :)words[1,CURRENT]}"
  local -a found open closed
  found=(${(f)"$(${words[1]} completion words -- $line 2>/dev/null)"})
  open=(${(M)found:#*=})
  closed=(${found:#*=})
  (( ${#found} )) || _files
  (( ${#open} )) && compadd -S '' -- $open
  (( ${#closed} )) && compadd -- $closed
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _lamp "$@"
else
  compdef _lamp lamp
fi
