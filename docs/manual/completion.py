#!/usr/bin/env python3
"""completion.py LUTETIA BENCH BASH ZSH - writes what completes `lutetia` in bash and in zsh, of what `lutetia help --table` says."""
import re
import sys

sys.dont_write_bytecode = True

import facts as facts_of

FILE = re.compile(r"FILE|FONT$|^F$|\.(mid|wav|lua)$")
SONGS = {"keys": "mid", "run": "lua"}  # the ending of a verb's own file


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def words_of(option):
    """What the value may be: the words of the table, or those of a value like light|dark|FILE."""
    found = [w for w in option.value.split("|") if not w.isupper()] if "|" in option.value else []
    return option.words or found


def is_file(option):
    return any(FILE.search(part) for part in option.value.split("|"))


# ---- bash ----

BASH = r"""# bash completion for lutetia. Made from the tables of its --help.

# Offers those of the words that begin with what is typed; words may have spaces in them.
_lutetia_words() {
  local suffix=$1 word typed=$cur quote=
  shift
  case $typed in
    \"* | \'*) quote=${typed:0:1} typed=${typed:1} ;;
    *) typed=${typed//\\/} ;;
  esac
  for word; do
    [[ $word == "$typed"* ]] || continue
    if [ -n "$quote" ]; then COMPREPLY+=("$word$suffix"); else COMPREPLY+=("$(printf '%q' "$word")$suffix"); fi
  done
  [ -z "$suffix" ] || compopt -o nospace 2>/dev/null
}

_lutetia_files() {
  compopt -o filenames 2>/dev/null
  local IFS=$'\n'
  COMPREPLY+=($(compgen "$@" -- "$cur"))
}

# Offers folders, and files that end so.
_lutetia_files_of() {
  _lutetia_files -d
  _lutetia_files -f -X "!*.$1"
}

_lutetia() {
  local cur=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
  COMPREPLY=()
  if [ "$cur" = = ]; then
    cur=
  elif [ "$previous" = = ]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if [ "$COMP_CWORD" = 1 ]; then
    _lutetia_words '' @VERBS@ --help --version
    return
  fi
  case $verb@$previous in
@VALUES@
  esac
  case $verb in
@WORDS@
    *) _lutetia_files -f ;;
  esac
}
complete -F _lutetia lutetia
"""


def names(option):
    return [f"--{option.name}"] + ([f"-{option.letter}"] if option.letter else [])


def bash_value(verb, option):
    pattern = " | ".join(f"{verb.name}@{name}" for name in names(option))
    does = []
    if words := words_of(option):
        does.append(f"_lutetia_words {quoted(option.suffix)} " + " ".join(map(quoted, words)))
    if option.value == "DIR":
        does.append("_lutetia_files -d")
    elif is_file(option):
        does.append("_lutetia_files -f")
    return f"    {pattern})\n" + "".join(f"      {line}\n" for line in [*does, "return"]) + "      ;;"


def bash(facts):
    values, words = [], []
    for verb in facts.verbs[1:]:
        values += [bash_value(verb, option) for option in verb.options if option.kind != "flag"]
        options = " ".join(name for option in verb.options for name in names(option)) + " --help"
        if verb.name == "cc":
            continue
        lines = [f"if [[ $cur == -* ]]; then _lutetia_words '' {options}"]
        if verb.commands:
            lines.append('elif [ "$COMP_CWORD" = 2 ]; then _lutetia_words \'\' ' + " ".join(c[0] for c in verb.commands))
        if verb.name in SONGS:
            lines.append(f"else _lutetia_files_of {SONGS[verb.name]}; fi")
        else:
            lines.append("else _lutetia_files -f; fi")
        words.append(f"    {verb.name})\n" + "".join(f"      {line}\n" for line in lines) + "      ;;")
    text = BASH.replace("@VERBS@", " ".join(v.name for v in facts.verbs[1:]))
    return text.replace("@VALUES@", "\n".join(values)).replace("@WORDS@", "\n".join(words))


# ---- zsh ----

ZSH = r"""#compdef lutetia
# zsh completion for lutetia. Made from the tables of its --help.

_lutetia() {
  local -a verbs
  if (( CURRENT == 2 )); then
    verbs=(
@VERBS@
    )
    _describe verb verbs
    return
  fi
  local verb=$words[2]
  shift words
  (( CURRENT-- ))
  case $verb in
@WORDS@
    *) _files ;;
  esac
}

_lutetia "$@"
"""


def zsh_text(text):
    """Within the brackets and colons of _arguments."""
    return re.sub(r"([\[\]:\\])", r"\\\1", text)


def zsh_action(option):
    words = words_of(option)
    listed = " ".join(re.sub(r"([ '\\:()])", r"\\\1", word) for word in words)
    if words and is_file(option):
        return f"_alternative {quoted(f'words:word:({listed})')} files:file:_files"
    if words:
        return f"compadd -S{option.suffix} -- {listed}" if option.suffix else f"({listed})"
    return "_files -/" if option.value == "DIR" else "_files" if is_file(option) else " "


def zsh_option(option):
    text = zsh_text(option.help)
    if option.kind == "flag":
        value = ""
    else:
        action = zsh_action(option)
        value = f":{zsh_text(option.value)}:" + (action if not action.startswith("compadd") else "{" + action + "}")
    many = "*" if option.kind in ("list", "texts") else ""
    sign = "" if option.kind == "flag" else "="
    short = "" if option.kind == "flag" else "+"
    rows = [quoted(f"{many}--{option.name}{sign}[{text}]{value}")]
    if option.letter:
        rows.append(quoted(f"{many}-{option.letter}{short}[{text}]{value}"))
    return rows


def zsh(facts):
    verbs = [f"      {quoted(v.name + ':' + v.help)}" for v in facts.verbs[1:]]
    words = []
    for verb in facts.verbs[1:]:
        if verb.name == "cc":
            continue
        rows = [row for option in verb.options for row in zsh_option(option)] + [quoted("--help[a summary]")]
        if verb.commands:
            rows.append(quoted("1:command:(" + " ".join(c[0] for c in verb.commands) + ")"))
        rows.append(quoted(f"*:file:_files -g \"*.{SONGS[verb.name]}\"" if verb.name in SONGS else "*:file:_files"))
        words.append(f"    {verb.name})\n      _arguments -s -S \\\n        " + " \\\n        ".join(rows) + "\n      ;;")
    return ZSH.replace("@VERBS@", "\n".join(verbs)).replace("@WORDS@", "\n".join(words))


def main():
    lutetia, bench, to_bash, to_zsh = sys.argv[1:5]
    facts = facts_of.read(lutetia, bench)
    open(to_bash, "w").write(bash(facts))
    open(to_zsh, "w").write(zsh(facts))


if __name__ == "__main__":
    main()
