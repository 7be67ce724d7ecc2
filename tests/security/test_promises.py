"""test_promises.py ROOT: each numbered sentence of docs/security.md is quoted by a test.

A test quotes a sentence by its number, in a comment: `security.md 8, 9`. The sentences are numbered from 1 without gaps. A quoted
number without a sentence is an error, too.
"""
import pathlib
import re
import sys

SENTENCE = re.compile(r"^(\d+)\. \S", re.MULTILINE)
QUOTE = re.compile(r"security\.md[\s*]+(\d+(?:,[\s*]+\d+)*)")  # also where a comment's line ends in between
SUFFIXES = (".c", ".h", ".py", ".sh")


def wrongs(page, tests):
    """The errors, one line each. tests: (name, text) of each test's file."""
    numbers = [int(number) for number in SENTENCE.findall(page)]
    found = ["docs/security.md: sentence %d stands where %d should" % (got, wanted)
             for wanted, got in enumerate(numbers, 1) if got != wanted]
    quoted = {}
    for name, text in tests:
        for quote in QUOTE.findall(text):
            for number in re.findall(r"\d+", quote):
                quoted.setdefault(int(number), []).append(name)
    found += ["docs/security.md: no test quotes sentence %d" % number for number in numbers if number not in quoted]
    found += ["%s: docs/security.md has no sentence %d" % (name, number)
              for number, names in sorted(quoted.items()) if number not in numbers for name in names]
    return found if numbers else ["docs/security.md has no numbered sentences"]


def checked():
    """Tests wrongs()."""
    page = "1. One.\n\ntext\n2. Two.\n"
    assert wrongs(page, [("a.c", "/* (security.md 1, 2) */")]) == []
    assert wrongs(page, [("a.c", "/* (security.md\n * 1,\n * 2) */")]) == []
    assert len(wrongs(page, [("a.c", "/* security.md 1 */")])) == 1
    assert len(wrongs(page, [("a.c", "/* security.md 1, 2, 3 */")])) == 1
    assert len(wrongs("1. One.\n3. Three.\n", [("a.c", "security.md 1, 3")])) == 1
    assert len(wrongs("", [])) == 1


def main():
    root = pathlib.Path(sys.argv[1])
    checked()
    here = pathlib.Path(__file__).resolve()
    tests = [(str(path.relative_to(root)), path.read_text()) for path in sorted((root / "tests").rglob("*"))
             if path.suffix in SUFFIXES and path.resolve() != here]
    found = wrongs((root / "docs/security.md").read_text(), tests)
    print("\n".join(found) if found else "every sentence is quoted")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
