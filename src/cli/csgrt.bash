# Completion for bash. The words come from `csgrt help`, so that they are the command's own.
_csgrt() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} first=${COMP_WORDS[1]} command=render
    local commands
    commands=$("${COMP_WORDS[0]}" help 2>/dev/null | sed -n 's/^  csgrt \([a-z]*\) .*/\1/p')
    if [[ $COMP_CWORD -eq 1 && $word != -* ]] || [[ $COMP_CWORD -eq 2 && $first == help ]]; then
        mapfile -t COMPREPLY < <(compgen -W "render $commands" -- "$word")
        [[ $first == help ]] || mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$word")
        return
    fi
    [[ " $commands " == *[[:space:]]"$first"[[:space:]]* ]] && command=$first
    local options choices
    options=$("${COMP_WORDS[0]}" help "$command" 2>/dev/null)
    # An option whose value is one of several words: "--format exr|png".
    choices=$(sed -n "s/^  \(-., \)\?$before \([a-z0-9-]*|[a-z0-9|-]*\)\( .*\)\?$/\2/p" <<<"$options")
    if [[ $before == -* && $choices ]]; then
        mapfile -t COMPREPLY < <(compgen -W "${choices//|/ }" -- "$word")
    elif [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(grep -o '^  [^ ]*,\? *--[a-z-]*' <<<"$options" | grep -o -- '--[a-z-]*')" \
            -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
}
complete -o filenames -F _csgrt csgrt
