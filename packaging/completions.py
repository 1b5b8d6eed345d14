#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes completions of the `noli` command for bash, zsh and fish, from what `noli COMMAND --help` prints.

    packaging/completions.py NOLI OUT     OUT/noli.bash, OUT/_noli, OUT/noli.fish

Commands come from the section "Commands:" of help texts, options from lines such as "  --order natural|given   ...". A value
that names alternatives (a|b) is completed by them, a value of any other kind by names of files.
"""
import re
import subprocess
import sys
from pathlib import Path

OPTION = re.compile(r"^  (?:(-\w), )?(--[\w-]+)(?: ([^ ]+(?:\|[^ ]+)*))?(?:  +(.*))?$")


def help_of(noli, words):
    return subprocess.run([noli, *words, "--help"], check=True, capture_output=True, text=True).stdout


def commands_in(text):
    section = re.search(r"\nCommands:\n((?:  .*\n)+)", text)
    return re.findall(r"^  (\w+) ", section.group(1), re.M) if section else []


def options_in(text):
    """(short name or None, name, value or None, description), of the groups of options: details below them may look alike"""
    found = []
    groups = re.findall(r"^(?!Examples|Commands|Arguments)[A-Z][\w ]*:\n((?:  .*\n)+)", text[text.find("\nOptions:"):], re.M)
    lines = "".join(groups).split("\n")
    for line, after in zip(lines, lines[1:] + [""]):
        match = OPTION.match(line)
        if match:
            short, name, value, meaning = match.groups()
            found.append((short, name, value, meaning or after.strip()))
    return found


def tree_of(noli):
    """Words of a command -> commands below it, its options."""
    tree, waiting = {}, [()]
    while waiting:
        words = waiting.pop()
        text = help_of(noli, words)
        below = commands_in(text)
        tree[words] = (below, options_in(text))
        waiting += [words + (name,) for name in below]
    return tree


def alternatives(value):
    return value.split("|") if value and "|" in value and value.lower() == value else []


def bash(tree):
    cases, values = [], {}
    for words, (below, options) in sorted(tree.items()):
        known = below + [name for _, name, _, _ in options]
        cases.append(f'    "{" ".join(words)}") known="{" ".join(known)}" ;;')
        for _, name, value, _ in options:
            if alternatives(value):
                values[name] = alternatives(value)
    chosen = "\n".join(f'    {name}) COMPREPLY=($(compgen -W "{" ".join(words)}" -- "$now")); return ;;'
                       for name, words in sorted(values.items()))
    return f"""# Completion of noli for bash, made from its help.
_noli() {{
  local now=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words="" known="" word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "|{"|".join(sorted(" ".join(w) for w in tree if w))}|" in
      *"|${{words:+$words }}$word|"*) words="${{words:+$words }}$word" ;;
      *) break ;;
    esac
  done
  case "$before" in
{chosen}
  esac
  case "$words" in
{chr(10).join(cases)}
  esac
  mapfile -t COMPREPLY < <(compgen -W "$known" -- "$now"; compgen -f -- "$now")
}}
complete -o filenames -F _noli noli
"""


def quoted(text):
    return text.replace("'", "’").replace("[", "(").replace("]", ")").replace(":", ";")


def zsh(tree):
    functions = []
    for words, (below, options) in sorted(tree.items()):
        lines = []
        for _, name, value, meaning in options:
            action = f":{value}:({' '.join(alternatives(value))})" if alternatives(value) else f":{value}:_files" if value else ""
            lines.append(f"    '{name}[{quoted(meaning)}]{quoted_action(action)}'")
        rest = f"'1:command:({' '.join(below)})'" if below else "'*:file:_files'"
        functions.append(f"_noli_{'_'.join(words)}() {{\n  _arguments \\\n" + " \\\n".join(lines + [f"    {rest}"]) + "\n}")
    depth = "\n".join(f'    "{" ".join(words)}") _noli_{"_".join(words)} ;;' for words in sorted(tree))
    return f"""#compdef noli
# Completion of noli for zsh, made from its help.
{chr(10).join(functions)}

_noli() {{
  local -a path=()
  local word
  for word in "${{words[@]:1:CURRENT-2}}"; do
    [[ $word == -* ]] && break
    (( $+functions[_noli_${{(j:_:)path}}${{path:+_}}$word] )) || break
    path+=("$word")
  done
  (( CURRENT -= $#path ))
  shift $#path words
  case "${{(j: :)path}}" in
{depth}
  esac
}}
_noli "$@"
"""


def quoted_action(action):
    return action.replace("'", "")


def fish(tree):
    lines = ["# Completion of noli for fish, made from its help."]
    for words, (below, options) in sorted(tree.items()):
        where = f"__fish_seen_subcommand_from {words[-1]}" if words else "__fish_use_subcommand"
        if len(words) == 2:
            where = f"__fish_seen_subcommand_from {words[0]}; and __fish_seen_subcommand_from {words[1]}"
        for name in below:
            lines.append(f"complete -c noli -n '{where}' -a {name}")
        for short, name, value, meaning in options:
            parts = [f"complete -c noli -n '{where}' -l {name[2:]}"]
            if short:
                parts.append(f"-s {short[1:]}")
            if alternatives(value):
                parts.append(f"-x -a '{' '.join(alternatives(value))}'")
            elif value:
                parts.append("-r")
            parts.append(f"-d '{quoted(meaning)}'")
            lines.append(" ".join(parts))
    return "\n".join(lines) + "\n"


def main():
    noli, out = sys.argv[1], Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    tree = tree_of(noli)
    (out / "noli.bash").write_text(bash(tree))
    (out / "_noli").write_text(zsh(tree))
    (out / "noli.fish").write_text(fish(tree))


if __name__ == "__main__":
    main()
