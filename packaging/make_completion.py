#!/usr/bin/python3
"""Writes the completion for bash: make_completion.py PROGRAM FILE. Commands and options are those of the program's
help, keys of --set those of its schema; names of sections, such as [contacts.tread], come from the case file on the
line that is being typed."""

import json
import sys

from commands import all_commands, read_command, say

SCRIPT = r"""# Completion of railwave's commands, options and keys for bash. Made by packaging/make_completion.py.
_railwave_keys='
@KEYS@
'

# Names NAME of the sections [$1.NAME] in the case files on the line.
_railwave_names() {
    local word
    for word in "${COMP_WORDS[@]}"; do
        case "$word" in
        *.toml) [ -r "$word" ] && sed -n "s/^[[:space:]]*\[$1\.\([A-Za-z0-9_-]*\)\].*/\1/p" "$word" ;;
        esac
    done | sort -u
}

# Keys that begin with $1, in which * stands for the name of a section.
_railwave_set() {
    local key section rest name
    for key in $_railwave_keys; do
        case "$key" in
        *.\*.*)
            section=${key%%.*} rest=${key#*.\*.}
            case "$1" in
            "$section".*) for name in $(_railwave_names "$section"); do echo "$section.$name.$rest="; done ;;
            *) echo "$section." ;;
            esac
            ;;
        *) echo "$key=" ;;
        esac
    done | sort -u
}

# The command of the words before the one at the cursor: "run", "signal psd".
_railwave_command() {
    local word command='' i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        word=${COMP_WORDS[i]}
        case " $(_railwave_commands "$command") " in
        *" $word "*) command="${command:+$command }$word" ;;
        esac
    done
    echo "$command"
}

_railwave_commands() {
    case "$1" in
@COMMANDS@
    esac
}

_railwave_options() {
    case "$1" in
@OPTIONS@
    esac
}

# Options that take something other than a file.
_railwave_values() {
    case "$1" in
@VALUES@
    *) return 1 ;;
    esac
}

_railwave() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command words file
    command=$(_railwave_command)
    COMPREPLY=()
    if [ "$before" = --set ]; then
        mapfile -t COMPREPLY < <(compgen -W "$(set -f && _railwave_set "$current")" -- "$current")
        compopt -o nospace
        return
    fi
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_railwave_options "$command")" -- "$current")
        return
    fi
    if _railwave_values "$before"; then return; fi
    words=$(_railwave_commands "$command")
    if [ -n "$words" ]; then
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
        return
    fi
    compopt -o filenames
    while IFS= read -r file; do
        case "$command" in
        run | check | mesh | modes | ensemble | sweep) [[ -d $file || $file == *.toml ]] || continue ;;
        esac
        COMPREPLY+=("$file")
    done < <(compgen -f -- "$current")
}
complete -F _railwave railwave
"""


def keys_of(schema):
    """Such as "time.end" and "contacts.*.friction", the star being the section's name."""
    keys = set()

    def collect(node, prefix, depth):
        for name, value in node.get("properties", {}).items():
            path = f"{prefix}{name}"
            if depth == 0 and "additionalProperties" in value and isinstance(value["additionalProperties"], dict):
                collect(value["additionalProperties"], f"{path}.*.", 1)
            elif depth == 0 and (value.get("type") == "object" or "properties" in value):
                collect(value, f"{path}.", 1)
            else:
                keys.add(path)
        for joined in ("allOf", "anyOf", "oneOf"):
            for part in node.get(joined, []):
                collect(part, prefix, depth)
        for branch in [b for b in ("then", "else") if b in node]:
            collect(node[branch], prefix, depth)

    collect(schema, "", 0)
    return sorted(keys)


def cases(pairs):
    """Lines of a shell's case; commands without values have none."""
    return "\n".join(f"    '{' '.join(words)}') echo '{' '.join(values)}' ;;" for words, values in pairs if values)


def completion(program):
    commands = list(all_commands(read_command(program)))
    below = [(c.words, [b.words[-1] for b in c.subcommands]) for c in commands]
    # `help` goes on with a command's name.
    below = [(words, below[0][1] if words == ("help",) else values) for words, values in below]
    options = [(c.words, [flag for option in c.options for flag in option.flags]) for c in commands]
    no_files = sorted({
        flag
        for c in commands
        for option in c.options
        if option.takes_value and "TEXT" not in option.name
        for flag in option.flags
    })
    values = f"    {' | '.join(no_files)}) ;;"
    text = SCRIPT.replace("@KEYS@", "\n".join(keys_of(json.loads(say(program, "reference", "--schema")))))
    return text.replace("@COMMANDS@", cases(below)).replace("@OPTIONS@", cases(options)).replace("@VALUES@", values)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: make_completion.py PROGRAM FILE")
    script = completion(sys.argv[1])
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(script)
