# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the bash completion of a program from its --help.

    bash_completion.py PROGRAM OUTPUT
"""
import pathlib
import sys

import help_text

SCRIPT = """# bash completion for {name}                              -*- shell-script -*-
{function}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  case "$before" in
{cases}  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "{options}" -- "$word")
  else
    mapfile -t COMPREPLY < <({positionals})
  fi
}}
complete -o filenames -o bashdefault -F {function} {name}
"""
FILES = 'compgen -f -- "$word"'


def case(option):
    """What may follow an option; nothing where it takes no value."""
    if not option.takes_value:
        return ""
    reply = ""
    if option.choices:
        reply = f'mapfile -t COMPREPLY < <(compgen -W "{" ".join(option.choices)}" -- "$word"); '
    elif option.takes_file:
        reply = f"mapfile -t COMPREPLY < <({FILES}); "
    return f"    {' | '.join(option.names)}) {reply}return ;;\n"


def script(name, text):
    options = " ".join(sorted({option_name for option in text.options for option_name in option.names}))
    commands = [entry.names[0] for entry in text.entries("subcommand")]
    positionals = f'compgen -W "{" ".join(commands)}" -- "$word"; {FILES}' if commands else FILES
    return SCRIPT.format(name=name, function="_" + name.replace("-", "_"), cases="".join(map(case, text.options)),
                         options=options, positionals=positionals)


def main(program, output):
    pathlib.Path(output).write_text(script(pathlib.Path(program).name, help_text.ask(program)), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
