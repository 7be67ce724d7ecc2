"""facts.py - reads what `lutetia help --table` prints: the facts of which manual pages and completions are made."""
import re
import subprocess
from dataclasses import dataclass, field


@dataclass
class Option:
    name: str
    letter: str
    kind: str
    value: str   # its name in the help; "" of a flag
    least: float
    most: float
    help: str
    words: list = field(default_factory=list)  # that it takes
    suffix: str = ""                           # what follows such a word: "=" of an amount


@dataclass
class Verb:
    name: str  # "" is the command itself
    arguments: str = ""
    help: str = ""
    usages: list = field(default_factory=list)
    about: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    commands: list = field(default_factory=list)  # (name, arguments, help)
    options: list = field(default_factory=list)
    examples: list = field(default_factory=list)  # (command, what it does)
    files: list = field(default_factory=list)     # (file, what it is)
    see: list = field(default_factory=list)


@dataclass
class Facts:
    version: str = ""
    verbs: list = field(default_factory=list)
    environment: list = field(default_factory=list)  # (name, value, group, what it does)
    exits: list = field(default_factory=list)        # (status, meaning)
    devices: list = field(default_factory=list)      # (kind and argument, what it is) of the MIDI server
    scripts: list = field(default_factory=list)      # (type or "", function) of the library for Lua


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def read(lutetia, bench):
    facts = Facts(verbs=[Verb("")])
    for line in output_of(lutetia, "help", "--table").splitlines():
        kind, *parts = line.split("\t")
        verb = facts.verbs[-1]
        if kind == "version":
            facts.version = parts[0]
        elif kind == "verb":
            facts.verbs.append(Verb(*parts))
        elif kind == "usage":
            verb.usages.append(parts[0])
        elif kind in ("about", "notes"):
            getattr(verb, kind).append(parts[0])
        elif kind == "command":
            verb.commands.append(tuple(parts))
        elif kind == "option":
            name, letter, of, value, least, most, text = parts
            verb.options.append(Option(name, letter, of, value, float(least), float(most), text))
        elif kind == "values":
            option = next(o for o in verb.options if o.name == parts[0])
            option.suffix, option.words = parts[1], parts[2].split(", ")
        elif kind == "example":
            verb.examples.append(tuple(parts))
        elif kind == "file":
            verb.files.append(tuple(parts[0].split(": ", 1)))
        elif kind == "see":
            verb.see = parts[0].split(", ")
        elif kind == "environment":
            facts.environment.append(tuple(parts))
        elif kind == "script":
            facts.scripts.append(tuple(parts))
        elif kind == "exit":
            facts.exits.append(tuple(parts))
        else:
            raise ValueError(f"a fact of an unknown kind: {line}")
    for line in output_of(lutetia, "midi", "devices", "kinds").splitlines():
        if found := re.match(r"  (\S+) +(.*)", line):
            facts.devices.append(found.groups())
    of_bench = next(v for v in facts.verbs if v.name == "bench")
    for line in output_of(bench, "--help").splitlines():
        if found := re.match(r"  (\S+) +(.*)", line):
            of_bench.commands.append((found.group(1), "", found.group(2)))
    return facts
