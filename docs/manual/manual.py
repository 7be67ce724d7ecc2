#!/usr/bin/env python3
"""manual.py LUTETIA BENCH SOURCE OUT STAMP - writes the manual pages, OUT/man1, man3 and man7: those of the command of what
`LUTETIA help --table` says (facts.py), those of instructions of SOURCE/paris_compat/instructions.tab, lutetia-scripts(7) of
docs/scripts.md and the functions that scripts have, paris(7) of paris.md and the README's example."""
import pathlib
import re
import shutil
import sys
import textwrap
from dataclasses import dataclass
from email.utils import parsedate_to_datetime

sys.dont_write_bytecode = True

import facts as facts_of
import roff
from roff import BOLD, ITALIC, ROMAN, Page, literal, prose, sentence

COMMAND, LIBRARY = "Lutetia", "C/Paris"

# Whose variables a verb's page lists, besides those of every program.
GROUPS = {"cc": ["paris"], "leds": ["paris"], "explain": ["paris"], "midi": ["midi"], "keys": ["midi"], "spring": ["midi"],
          "voice": ["midi"]}
NAMED = {"cc": ["CC"], "tune": ["XDG_CACHE_HOME"], "info": ["XDG_CACHE_HOME", "POCL_CACHE_DIR"], "midi": ["XDG_RUNTIME_DIR"],
         "leds": ["DISPLAY"], "keys": ["DISPLAY"], "spring": ["DISPLAY"], "voice": ["DISPLAY"]}


@dataclass
class Edition:
    version: str
    date: str


def released(source):
    """The date of the release: the newest entry's of debian/changelog."""
    text = (source / "debian/changelog").read_text()
    return parsedate_to_datetime(re.search(r"^ -- .*>  (.*)$", text, re.M).group(1)).date().isoformat()


# ---- the command's pages ----

def usage_line(name, usage):
    """Words in capitals and in quotes stand for something: slanted; the rest is typed."""
    words = []
    for word in f"lutetia {name} {usage}".split():
        bare = word.strip('[].\"')
        stands = re.fullmatch(r"[A-Z]+(\.\w+)?", bare) or word.startswith('"') or bare in (
            "options", "arguments", "prog", "prog.c", "recording", "key=value", "word", "Text") or word.endswith('compiler]') or \
            word in ("of", "the", "C")
        words.append((ITALIC if stands else BOLD) + literal(word) + ROMAN)
    return " ".join(words)


def number(value):
    return f"{value:.10g}"


def option_texts(option):
    """The help as sentences: what it does, what it takes, what is taken without it."""
    text, default = option.help, ""
    if found := re.fullmatch(r"(.*\S) \(([^()]*)\)", text):
        if not found.group(2).startswith("."):
            text, default = found.groups()
    out = [sentence(text)]
    if option.least < option.most and ".." not in text:
        each = "Each is from" if option.kind in ("numbers", "size", "list") else "From"
        out.append(f"{each} {number(option.least)} to {number(option.most)}.")
    if option.words and not all(w in option.help + option.value for w in option.words):
        out.append("One of " + ", ".join(f"`{w}`" for w in option.words) + ".")
    if default:
        out.append(f"Default: {default}.")
    return " ".join(out)


def option_term(option):
    value = f"{ITALIC}{literal(option.value)}{ROMAN}" if option.kind != "flag" else ""
    short = f"{BOLD}\\-{option.letter}{ROMAN}{' ' if value else ''}{value}, " if option.letter else ""
    return f"{short}{BOLD}\\-\\-{literal(option.name)}{ROMAN}{'=' if value else ''}{value}"


def environment(page, rows):
    for name, value, _, does in rows:
        shown = f"={ITALIC}{literal(value)}{ROMAN}" if re.search("[A-Z]", value) else f"={literal(value)}"
        page.item(f"{BOLD}{literal(name)}{ROMAN}{shown}", sentence(does))


def tail(page, facts, verb, rows):
    """The sections that end each page of the command."""
    page.section_begin("ENVIRONMENT")
    environment(page, rows)
    if verb.name:
        page.paragraph("lutetia(1) lists the others.")
    if verb.files:
        page.section_begin("FILES")
        for name, what in verb.files:
            page.item(ITALIC + literal(name) + ROMAN, sentence(what))
    page.section_begin("EXIT STATUS")
    for status, means in facts.exits:
        page.item(BOLD + status + ROMAN, means)
    page.section_begin("EXAMPLES")
    for command, does in verb.examples:
        page.paragraph(sentence(does)[:-1] + ":")
        page.code([command])


def synopsis(page, verb):
    page.section_begin("SYNOPSIS")
    page.add(".nf", *(usage_line(verb.name, usage) for usage in verb.usages), ".fi")


def command_page(facts, verb, edition):
    page = Page("LUTETIA\\-" + verb.name.upper(), 1, edition, COMMAND)
    page.section_begin("NAME")
    page.add(f"lutetia\\-{verb.name} \\- {prose(verb.help)}")
    synopsis(page, verb)
    page.section_begin("DESCRIPTION")
    for text in verb.about:
        page.paragraph(text)
    if verb.commands:
        page.section_begin("COMMANDS")
        for name, arguments, text in verb.commands:
            page.item(f"{BOLD}{literal(name)}{ROMAN} {ITALIC}{literal(arguments)}{ROMAN}".replace(f" {ITALIC}{ROMAN}", ""),
                      sentence(text))
    if verb.name == "midi":
        page.section_begin("DEVICES")
        for kind, text in facts.devices:
            page.item(BOLD + literal(kind) + ROMAN, sentence(text))
    page.section_begin("OPTIONS")
    for option in verb.options:
        page.item(option_term(option), option_texts(option))
    page.item(f"{BOLD}\\-h{ROMAN}, {BOLD}\\-\\-help{ROMAN}", "Prints a summary, and ends.")
    if verb.notes:
        page.section_begin("NOTES")
        for text in verb.notes:
            page.paragraph(text)
    groups = ["user"] + GROUPS.get(verb.name, [])
    tail(page, facts, verb, [r for r in facts.environment if r[2] in groups or r[0] in NAMED.get(verb.name, [])])
    page.see_also(["lutetia(1)"] + [name for name in verb.see if name != "lutetia(1)"])
    return page.text()


def main_page(facts, edition):
    verb, *verbs = facts.verbs
    page = Page("LUTETIA", 1, edition, COMMAND)
    page.section_begin("NAME")
    page.add("lutetia \\- a Connection Machine in software: watercolour, springy and played type")
    synopsis(page, verb)
    page.section_begin("DESCRIPTION")
    for text in verb.about:
        page.paragraph(text)
    page.section_begin("COMMANDS")
    for v in verbs:
        page.item(f"{BOLD}{v.name}{ROMAN} {ITALIC}{literal(v.arguments)}{ROMAN}",
                  f"{sentence(v.help)} See lutetia-{v.name}(1).")
    page.section_begin("OPTIONS")
    page.item(f"{BOLD}\\-h{ROMAN}, {BOLD}\\-\\-help{ROMAN}", "Lists the commands, and ends; behind a command, its options.")
    page.item(f"{BOLD}\\-\\-version{ROMAN}", "Prints the version, and ends.")
    tail(page, facts, verb, [r for r in facts.environment if r[2] != "engine"])
    page.section_begin("VARIABLES OF THE ENGINE")
    page.paragraph("These force decisions that the engine makes by itself. Results are the same bits with each; they are for "
                   "measuring and for tests.")
    environment(page, [r for r in facts.environment if r[2] == "engine"])
    page.see_also([f"lutetia-{v.name}(1)" for v in verbs] + verb.see)
    return page.text()


# ---- scripts ----

def scripts_page(facts, source, edition):
    page = Page("LUTETIA\\-SCRIPTS", 7, edition, COMMAND)
    page.section_begin("NAME")
    page.add("lutetia\\-scripts \\- papers, inks, masks, springs and time in Lua")
    page.section_begin("DESCRIPTION")
    text = (source / "docs/scripts.md").read_text()
    roff.markdown(page, re.sub(r"\| option \|.*?\n\n", "lutetia-run(1) lists the options.\n\n", text, count=1, flags=re.S))
    page.section_begin("FUNCTIONS")
    page.paragraph("All that a script can call, besides Lua's own:")
    kinds = {}
    for kind, name in facts.scripts:
        kinds.setdefault(kind, []).append(name)
    for kind, names in kinds.items():
        page.item(f"{BOLD}{kind or 'everywhere'}{ROMAN}", ", ".join(sorted(names)) + ".")
    page.section_begin("FILES")
    page.item(f"{ITALIC}/usr/share/doc/lutetia{ROMAN}", "The documents and examples that this page names.")
    page.see_also(["lutetia-run(1)", "lutetia-spring(1)", "lutetia-keys(1)", "lua(1)"])
    return page.text()


# ---- the instructions ----

def families(sections):
    """[(page's name, [(section's title, cells, functions)])]: rows of one name together, calls by their section."""
    out = {}
    for title, rows in sections:
        first = next((functions[0].name for cells, functions in rows if cells[0] == "call"), None)
        for cells, functions in rows:
            if cells[0] == "call":
                name = first
            elif cells[0] == "combine":
                name = f"CM_scan_with_{cells[2]}"
            else:
                name = "CM_" + (cells[2] if cells[2] != "-" else cells[0])
            out.setdefault(name, []).append((title, cells, functions))
    return out


def prototype(generate, function):
    """Broken like a line of C: a continuation is below the first parameter or indented."""
    text = generate.prototype(function) + ";"
    return textwrap.wrap(text, 84, subsequent_indent="        ", break_long_words=False, break_on_hyphens=False)


def family_page(generate, name, rows, edition):
    page = Page(name, 3, edition, LIBRARY)
    is_calls = rows[0][1][0] == "call"
    titles = list(dict.fromkeys(title for title, _, _ in rows))
    page.section_begin("NAME")
    names = [f.name for _, _, functions in rows for f in functions] if is_calls else [name]
    what = "; ".join(t[0].lower() + t[1:] for t in titles)
    page.add(f"{', '.join(names)} \\- {prose(what)}")
    page.section_begin("SYNOPSIS")
    page.add(".nf", f"{BOLD}#include <cm/paris.h>{ROMAN}", "")
    at = None
    for title, cells, functions in rows:
        if not is_calls and len(rows) > 1:
            page.add(*([""] if at else []), f"/* {literal(title)} */")
        at = title
        for function in functions:
            if "_const_" not in function.name:
                page.add(*(BOLD + literal(line) + ROMAN for line in prototype(generate, function)))
    page.add(".fi")
    page.section_begin("DESCRIPTION")
    for title, cells, functions in rows:
        if is_calls:
            page.item(f"{BOLD}{literal(functions[0].name)}{ROMAN}", sentence(cells[2]))
            continue
        if len(rows) > 1:
            page.subsection(title)
        page.paragraph(sentence(cells[5]) + (" Sets overflow." if "overflow" in cells[4].split() else ""))
    if not is_calls:
        page.paragraph("A name with `constant` is spelt with `const`, too. Other forms of names, and what lengths and operands "
                       "are, paris(7) tells.")
    page.section_begin("CONTEXT")
    page.paragraph("Destinations and flags change only in active processors; `always` forms change dest in all of them.")
    page.section_begin("ERRORS")
    page.paragraph("A wrong call has no effect, and is explained in one line to the error handler; see "
                   "CM_set_error_handler(3) and CM_error_status(3).")
    page.see_also(["paris(7)", "lutetia-cc(1)"])
    return page.text()


def paris_page(sections, source, edition):
    page = Page("PARIS", 7, edition, LIBRARY)
    page.section_begin("NAME")
    page.add("paris \\- C/Paris, the Connection Machine's parallel instruction set")
    text = (source / "docs/manual/paris.md").read_text()
    readme = (source / "README.md").read_text()
    example = re.search(r"```c\n(.*?)```", readme, re.S).group(1)
    listed = []
    pages = families(sections)
    for title, _ in sections:
        names = [f"{name}(3)" for name, rows in pages.items() if any(t == title for t, _, _ in rows)]
        listed.append(f"### {title}\n\n{', '.join(names)}.\n")
    roff.markdown(page, text.replace("@EXAMPLE@", example).replace("@FAMILIES@", "\n".join(listed)))
    page.see_also(["lutetia(1)", "lutetia-cc(1)", "lutetia-explain(1)", "lutetia-leds(1)"])
    return page.text()


def main():
    lutetia, bench, source, out, stamp = sys.argv[1:6]
    source, out = pathlib.Path(source), pathlib.Path(out)
    sys.path.insert(0, str(source / "paris_compat"))
    import generate
    facts = facts_of.read(lutetia, bench)
    edition = Edition(facts.version, released(source))
    sections = generate.read_table(source / "paris_compat/instructions.tab")
    shutil.rmtree(out, ignore_errors=True)
    for section in "137":
        (out / f"man{section}").mkdir(parents=True)
    (out / "man1/lutetia.1").write_text(main_page(facts, edition))
    for verb in facts.verbs[1:]:
        (out / f"man1/lutetia-{verb.name}.1").write_text(command_page(facts, verb, edition))
    (out / "man7/lutetia-scripts.7").write_text(scripts_page(facts, source, edition))
    (out / "man7/paris.7").write_text(paris_page(sections, source, edition))
    pages = families(sections)
    for name, rows in pages.items():
        (out / f"man3/{name}.3").write_text(family_page(generate, name, rows, edition))
    for name, rows in pages.items():
        for function in (f for _, _, functions in rows for f in functions):
            link = out / f"man3/{function.name}.3"
            if function.name not in pages:
                link.symlink_to(f"{name}.3")
    pathlib.Path(stamp).write_text(facts.version + "\n")


if __name__ == "__main__":
    main()
