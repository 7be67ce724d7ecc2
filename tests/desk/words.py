"""words.py [--write] ROOT: the texts that the studio and the reader show are all in po/lutetia.pot, and no others.

_("...") is a text where it is shown, N_("...") one of a table. The studio's controls are a table whose rows, ROW(...), are texts
without either: the name of a control and its choices are shown with blanks, and begin with a capital letter. --write makes the file.
"""
import os
import re
import sys

HEAD = '''# Texts of the studio and the reader; docs/studio.md says how they are translated.
# python3 tests/desk/words.py --write . makes this file.
msgid ""
msgstr ""
"Content-Type: text/plain; charset=UTF-8\\n"
"Content-Transfer-Encoding: 8bit\\n"

'''
LITERAL = r'"(?:[^"\\]|\\.)*"'
LITERALS = rf"{LITERAL}(?:\s*{LITERAL})*"
MARKED = re.compile(rf"\bN?_\(\s*({LITERALS})\s*\)")
ROW = re.compile(rf'\bROW\(\s*STUDIO_\w+(?: \+ n - 1)?, "(\w+)"[^"]*("[^"]*"),(.*?)({LITERALS})\)', re.S)
COMMENT = re.compile(r"/\*.*?\*/|^#include[^\n]*", re.S | re.M)
# What begins as a sentence does, and is not made of names and signs, and is no key and no axis of X's.
SENTENCE = re.compile(r'"(?!(?:Ctrl|Control|Alt|Shift)\+|Abs )[A-Z][a-z]+(?:\b|…)[^<>_{}:/%]*"')


def joined(literals):
    return "".join(part[1:-1] for part in re.findall(LITERAL, literals))


def label(name):
    text = name.replace("_", " ")
    return text[:1].upper() + text[1:]


def sources(root):
    for folder, _, files in sorted(os.walk(os.path.join(root, "desk"))):
        for name in sorted(files):
            if name.endswith(".c"):
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as file:
                    yield os.path.relpath(path, root), file.read()


def texts(root):
    """Each text, and the files that have it."""
    found = {}
    for path, source in sources(root):
        all_of = [joined(match) for match in MARKED.findall(source)]
        for name, _, choices, does in ROW.findall(source):
            words = " ".join(joined(part) for part in re.findall(LITERAL, choices)).split()
            all_of += ([label(name)] if name[-1] != "_" else []) + [joined(does)] + [label(word) for word in words]
        for text in all_of:
            found.setdefault(text, []).append(path)
    return {text: sorted(set(paths)) for text, paths in found.items() if text}


def template(found):
    order = sorted(found.items(), key=lambda item: (item[1][0], item[0]))
    entries = []
    for text, paths in order:
        kind = "#, c-format\n" if re.search(r"%[-+ #0-9.]*[a-z]", text) else ""
        entries.append("".join(f"#: {path}\n" for path in paths) + f'{kind}msgid "{text}"\nmsgstr ""\n')
    return HEAD + "\n".join(entries)


def blanked(pattern, source):
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), source)


def bare(root):
    """Texts that nobody can translate."""
    for path, source in sources(root):
        for pattern in (COMMENT, MARKED, ROW):
            source = blanked(pattern, source)
        for match in re.finditer(LITERAL, source):
            if SENTENCE.fullmatch(match[0]):
                yield f"{path}:{source.count(chr(10), 0, match.start()) + 1}: {match[0]}"


def main(root, write):
    path = os.path.join(root, "po", "lutetia.pot")
    wanted = template(texts(root))
    if write:
        with open(path, "w", encoding="utf-8") as file:
            file.write(wanted)
        return 0
    with open(path, encoding="utf-8") as file:
        known = file.read()
    missing = sorted(set(re.findall(r'^msgid (".*")$', wanted, re.M)) - set(re.findall(r'^msgid (".*")$', known, re.M)))
    for text in missing[:10]:
        print(f"not in po/lutetia.pot: {text}")
    unmarked = list(bare(root))
    for line in unmarked:
        print(f"neither _() nor N_(): {line}")
    if known != wanted:
        print("po/lutetia.pot is not what the sources say: python3 tests/desk/words.py --write . makes it anew")
    print(f"{wanted.count('msgid') - 1} texts")
    return 1 if known != wanted or unmarked else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[-1], "--write" in sys.argv))
