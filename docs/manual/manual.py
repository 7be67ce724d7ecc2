#!/usr/bin/env python3
"""manual.py LUTETIA BENCH SOURCE OUT STAMP - writes the manual pages, OUT/man1, man3 and man7: those of the command of what
`LUTETIA help --table` says (facts.py), those of instructions of SOURCE/paris_compat/instructions.tab, lutetia-scripts(7) of
docs/scripts.md, what docs/midi.md says of maps and the functions that scripts have, paris(7) of paris.md and the README's example."""
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
GROUPS = {"cc": ["paris"], "leds": ["paris"], "display": ["paris"], "explain": ["paris"], "debug": ["paris"], "midi": ["midi"], "keys": ["midi"],
          "spring": ["midi"],
          "voice": ["midi"]}
NAMED = {"cc": ["CC"], "tune": ["XDG_CACHE_HOME"], "info": ["XDG_CACHE_HOME", "POCL_CACHE_DIR"], "midi": ["XDG_RUNTIME_DIR"],
         "leds": ["DISPLAY"], "display": ["DISPLAY"], "keys": ["DISPLAY"], "spring": ["DISPLAY"], "voice": ["DISPLAY"]}


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
    text = documents(text)
    roff.markdown(page, re.sub(r"\| option \|.*?\n\n", "lutetia-run(1) lists the options.\n\n", text, count=1, flags=re.S))
    found = re.search(r"^## Maps: .*?\n(.*?)^## ", (source / "docs/midi.md").read_text(), re.M | re.S)
    page.section_begin("MAPS")
    roff.markdown(page, found.group(1))
    page.section_begin("FUNCTIONS")
    page.paragraph("All that a script can call, besides Lua's own:")
    kinds = {}
    for kind, name in facts.scripts:
        kinds.setdefault(kind, []).append(name)
    for kind, names in kinds.items():
        page.item(f"{BOLD}{kind or 'everywhere'}{ROMAN}", ", ".join(sorted(names)) + ".")
    page.section_begin("FILES")
    page.item(f"{ITALIC}/usr/share/doc/lutetia{ROMAN}", "The documents and examples that this page names; a long document may be packed (.gz).")
    page.see_also(["lutetia-run(1)", "lutetia-spring(1)", "lutetia-keys(1)", "lutetia-midi(1)", "lua(1)"])
    return page.text()


# ---- the instructions ----

# What a row's types are called, where rows of one title are together on a page.
TYPES = {"f": "floats", "su": "integers", "u": "unsigned integers", "s": "signed integers", "c": "complex numbers"}
NAME_ROOM = 90  # characters of what a page's NAME says
SEE_MOST = 8


def families(sections):
    """[(page's name, [(section's title, cells, functions)])]: rows of one name together, calls by their section."""
    out = {}
    for title, rows in sections:
        first = next((functions[0].name for cells, functions in rows if cells[0] == "call"), None)
        for cells, functions in rows:
            if cells[0] == "call":
                name = first
            elif cells[2] == "-":
                name = functions[0].name
            elif cells[0] == "combine":
                name = f"CM_scan_with_{cells[2]}"
            else:
                name = "CM_" + cells[2]
            out.setdefault(name, []).append((title, cells, functions))
    return out


def prototype(generate, function):
    """Broken like a line of C: a continuation is below the first parameter or indented."""
    text = generate.prototype(function) + ";"
    return textwrap.wrap(text, 84, subsequent_indent="        ", break_long_words=False, break_on_hyphens=False)


def operands_read(path):
    """{operand, or "type operand": what it is}, in the order of operands.md."""
    rows = [roff.cells(line) for line in path.read_text().splitlines() if line.startswith("| `")]
    return {name.strip("`"): text for name, text in rows}


def parameters(function):
    """[(type, name)]; a row of `call` has them as it writes them."""
    if not function.params or function.params[0][0]:
        return function.params
    out = []
    for text in re.sub(r"\(\*(\w+)\) \(.*\)", r"\1", function.params[0][1]).split(", "):
        kind, name = re.fullmatch(r"(.*?[ *])?(\w+)", text).groups()
        out += [] if name == "void" else [(kind.strip(), name)]
    return out


def operands_used(rows, texts):
    """[(names, what they are)] of a page, in the order of operands.md."""
    used = {}
    all_names = {name for _, _, functions in rows for function in functions for _, name in parameters(function)}
    for _, _, functions in rows:
        for function in functions:
            for kind, name in parameters(function):
                kind = kind.replace("const ", "")
                key = f"{kind} {name}" if f"{kind} {name}" in texts else name
                if name == "source" and "source1" in all_names:
                    key = "source beside source1"
                if key not in texts:
                    raise KeyError(f"{function.name}: docs/manual/operands.md does not say what `{name}` ({kind}) is")
                if name not in used.setdefault(texts[key], []):
                    used[texts[key]].append(name)
    return [(used[text], text) for text in dict.fromkeys(texts.values()) if text in used]


def lower(text):
    """The first letter small, but of NEWS."""
    return text if text[1:2].isupper() else text[:1].lower() + text[1:]


def first_clause(text):
    """Up to the first semicolon or colon that is not in brackets; an explanation in brackets at its end is left out."""
    text = re.sub(r"(?<! not) \([^()]*\)$", "", re.split(r";|(?<! ):(?= |$)", re.sub(r"\([^()]*[:;][^()]*\)", "", text))[0].strip())
    return "" if text.startswith(("the same", "another spelling")) else text


def in_short(rows):
    """What the rows do, if it is short; else the sections that they are in."""
    said = [(cells[0], first_clause(cells[5])) for _, cells, _ in rows if cells[0] != "call"]
    does = list(dict.fromkeys(text for shape, text in said if text and shape not in ("global", "globalflag")))
    text = "; ".join(map(lower, does))
    if text and said[0][0] == "combine":
        text = "scans, spreads and reductions along axes: " + text
    if text and len(text) <= NAME_ROOM:
        return text
    return "; ".join(lower(title) for title in dict.fromkeys(title for title, _, _ in rows))


def row_titles(rows):
    """A title for each row: its section's, with the types where several rows have the same."""
    titles = [title for title, _, _ in rows]
    return [f"{title}: {TYPES[cells[1]]}" if titles.count(title) > 1 and cells[1] in TYPES else title for title, cells, _ in rows]


def forms(page, functions):
    """Functions of a row that each do something else: an item for all that do the same."""
    same = {}
    for function in functions:
        same.setdefault(function.doc, []).append(f"{BOLD}{literal(function.name)}{ROMAN}")
    for text, names in same.items():
        page.item(", ".join(names), sentence(text))


def context(rows):
    """What the context has to do with it; "" of calls that touch no field."""
    functions = [f for _, _, fs in rows for f in fs]
    if all(cells[:3] == ["flag", "-", "context"] or cells[0] == "globalflag" for _, cells, _ in rows):
        return "Operations on the context are done in all processors, active or not."
    if all("whatever the context" in cells[5] or cells[0] == "cfrontend" for _, cells, _ in rows if cells[0] != "call") and \
            rows[0][1][0] != "call":
        return "The context does not matter." if rows[0][1][0] != "cfrontend" else \
            "Arrays and single processors: it does not matter. Neighbours: dest changes only in active processors."
    writes = any(name == "dest" for f in functions for _, name in parameters(f)) or \
        any(cells[0] in ("compare", "ccompare", "float_test", "flag") for _, cells, _ in rows)
    if not writes:
        return ""
    always = any("_always" in f.name for f in functions)
    return "Destinations and flags change only in active processors" + \
        ("; `always` forms change dest in all of them." if always else ".")


def family_page(generate, name, rows, others, texts, edition):
    page = Page(name, 3, edition, LIBRARY)
    is_calls = rows[0][1][0] == "call"
    titles = row_titles(rows)
    page.section_begin("NAME")
    named = is_calls or rows[0][1][2] == "-"
    names = [f.name for _, _, functions in rows for f in functions] if named else [name]
    page.add(f"{', '.join(names)} \\- {literal(in_short(rows))}")
    page.section_begin("SYNOPSIS")
    page.add(".nf", f"{BOLD}#include <cm/paris.h>{ROMAN}", "")
    at = None
    for title, (_, cells, functions) in zip(titles, rows):
        if not is_calls and len(rows) > 1:
            page.add(*([""] if at else []), f"/* {literal(title)} */")
        at = title
        for function in functions:
            if "_const_" not in function.name:
                page.add(*(BOLD + literal(line) + ROMAN for line in prototype(generate, function)))
    page.add(".fi")
    page.section_begin("DESCRIPTION")
    for title, (_, cells, functions) in zip(titles, rows):
        if is_calls:
            page.item(f"{BOLD}{literal(functions[0].name)}{ROMAN}", sentence(documents(cells[2])))
            continue
        if len(rows) > 1:
            page.subsection(title)
        page.paragraph(sentence(documents(cells[5])) + (" Sets overflow." if "overflow" in cells[4].split() else ""))
        if len({f.doc for f in functions}) > 1:
            forms(page, [f for f in functions if "_const_" not in f.name])
    if not is_calls:
        page.paragraph("The parts of a name, such as `_2_1L`, `constant` (also spelt `const`) and `always`, are explained in "
                       "paris(7).")
    operands = operands_used(rows, texts)
    if operands:
        page.section_begin("OPERANDS")
        for names, text in operands:
            page.item(", ".join(f"{ITALIC}{literal(n)}{ROMAN}" for n in names), sentence(text))
    notes = [generate.along_axes.NOTES[t] for t in dict.fromkeys(t for t, _, _ in rows) if t in generate.along_axes.NOTES]
    if notes:
        page.section_begin("NOTES")
        for text in notes:
            page.paragraph(re.sub(r"\*(\w+)\*", r"\1", " ".join(text.split())))
    if about := context(rows):
        page.section_begin("CONTEXT")
        page.paragraph(about)
    page.section_begin("ERRORS")
    page.paragraph("A wrong call has no effect, and is explained in one line to the error handler; see "
                   "CM_set_error_handler(3) and CM_error_status(3).")
    page.see_also(["paris(7)", "lutetia-cc(1)"] + [f"{other}(3)" for other in others])
    return page.text()


def documents(text):
    """Where a document is once it is installed."""
    return re.sub(r"\bdocs/([\w-]+\.md)", r"/usr/share/doc/lutetia/\1", text)


def neighbours(pages):
    """{page's name: those of the same sections that follow and precede it most nearly}"""
    names = list(pages)
    out = {}
    for at, name in enumerate(names):
        titles = {title for title, _, _ in pages[name]}
        near = sorted((abs(i - at), other) for i, other in enumerate(names)
                      if other != name and titles & {title for title, _, _ in pages[other]})
        out[name] = sorted(other for _, other in near[:SEE_MOST])
    return out


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
    page.see_also(["lutetia(1)", "lutetia-cc(1)", "lutetia-explain(1)", "lutetia-leds(1)", "lutetia-display(1)"])
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
    others, texts = neighbours(pages), operands_read(source / "docs/manual/operands.md")
    for name, rows in pages.items():
        (out / f"man3/{name}.3").write_text(family_page(generate, name, rows, others[name], texts, edition))
    for name, rows in pages.items():
        for function in (f for _, _, functions in rows for f in functions):
            link = out / f"man3/{function.name}.3"
            if function.name not in pages:
                link.symlink_to(f"{name}.3")
    pathlib.Path(stamp).write_text(facts.version + "\n")


if __name__ == "__main__":
    main()
