# Completes command lines of launchsafe: eval "$(launchsafe --bash-completion)"
_launchsafe() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} options= values= files= folders=
  local keys='{{#keys}}{{.}} {{/keys}}'
  # bash parts --option=value in three
  if [[ $word == = ]]; then word=; elif [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi
  case "$COMP_CWORD ${COMP_WORDS[1]}" in
    1\ *) values='{{#commands}}{{name}} {{/commands}}' ;;
{{#commands}}
    *\ {{name}})
      options='{{names}}'
      case $previous in
{{#options}}
        {{names}}) {{take}} ;;
{{/options}}
        *) {{positional}} ;;
      esac ;;
{{/commands}}
  esac
  if [[ $word == -* ]]; then values=$options files= folders=; fi
  # of a list with commas the last word
  local before=${word%"${word##*,}"}
  COMPREPLY=($(compgen -P "$before" -W "$values" -- "${word##*,}"))
  if [[ $files || $folders ]]; then COMPREPLY+=($(compgen -d -- "$word")); compopt -o filenames 2>/dev/null; fi
  if [[ $files ]]; then COMPREPLY+=($(compgen -f -X "!*.$files" -- "$word")); fi
  if [[ ${COMPREPLY-} == *= ]]; then compopt -o nospace 2>/dev/null; fi
}
complete -F _launchsafe launchsafe
