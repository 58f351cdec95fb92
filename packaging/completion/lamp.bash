# Completes command lines of lamp in bash, which asks lamp for the words.
# To bash, '=' and ':' end words too: what stands before them in a word is cut off the answers.
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
_lamp() {
  local line=${COMP_LINE:0:COMP_POINT}
  local word=${line##*[[:space:]]}
  mapfile -t COMPREPLY < <("$1" completion words -- "$line" 2>/dev/null)
  COMPREPLY=("${COMPREPLY[@]#"${word%"${word##*[=:]}"}"}")
  if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace 2>/dev/null; fi
}
complete -o default -F _lamp lamp
