"""totals.py TESTLOG.json: reads the log of `meson test` and prints `N passed, N failed[, N skipped]`.

Before it, a line each: what failed, with the last of what it printed, and what was skipped with its reason, the last line that it printed before it was.
Counts the cases of cmocka programs, which have many each. Any other test counts as one, and so does a program that ended
before its total. Ends with 1 if anything failed.
"""
import json
import re
import sys

CASE = re.compile(r"^\[ *(OK|FAILED|SKIPPED|ERROR) *\] (\w+)$", re.MULTILINE)
END = re.compile(r"^\[==========\].* (\d+) test\(s\) run\.", re.MULTILINE)


def cases(test):
    """The cases of one logged test: a list of (name, passed | failed | skipped)."""
    if test["result"] == "EXPECTEDFAIL":
        return [("", "passed")]
    text = test.get("stdout", "") + "\n" + test.get("stderr", "")
    lines = CASE.findall(text)
    found = [(name, "passed") for outcome, name in lines if outcome == "OK"]
    # cmocka lists failed and skipped cases again at the end; count them once.
    found += sorted({(name, "skipped" if outcome == "SKIPPED" else "failed")
                     for outcome, name in lines if outcome != "OK"})
    failed = any(outcome == "failed" for _, outcome in found)
    if test["result"] not in ("OK", "SKIP") and not (failed and END.search(text)):
        found.append(("(%s)" % test["result"].lower(), "failed"))
    elif not found:
        found.append(("", "skipped" if test["result"] == "SKIP" else "passed"))
    return found


def reason(test, name):
    """The last line that the test, or this case of it, printed before it was skipped."""
    text = test.get("stdout", "") if name else test.get("stdout", "") + "\n" + test.get("stderr", "")
    if name:
        begin = text.find("] " + name + "\n")
        text = text[begin + len(name) + 3:]
        end = re.search(r"^\[ *SKIPPED *\] " + name + "$", text, re.MULTILINE)
        text = text[:end.start()] if end else text
    said = [line.strip() for line in text.splitlines() if line.strip() and not line.startswith("[")]
    return said[-1].removeprefix("skipped: ") if said else "no reason was printed"


def last_words(test):
    """The last lines of what a test printed, less what cmocka says of cases that passed."""
    text = test.get("stdout", "") + "\n" + test.get("stderr", "")
    said = [line.rstrip() for line in text.splitlines()
            if line.strip() and not re.match(r"\[ *(RUN|OK|PASSED|=+) *\]", line)]
    return ["    " + line[:200] for line in said[-12:]]


def main(path):
    totals = {"passed": 0, "failed": 0, "skipped": 0}
    with open(path, encoding="utf-8") as log:
        for line in log:
            test = json.loads(line)
            for name, outcome in cases(test):
                totals[outcome] += 1
                if outcome == "failed":
                    print("\n".join(["FAILED %s %s" % (test["name"], name)] + last_words(test)))
                elif outcome == "skipped":
                    print("skipped %s: %s" % ((test["name"] + " " + name).strip(), reason(test, name)))
    skipped = ", %d skipped" % totals["skipped"] if totals["skipped"] else ""
    print("%d passed, %d failed%s" % (totals["passed"], totals["failed"], skipped))
    return 1 if totals["failed"] or not totals["passed"] else 0


sys.exit(main(sys.argv[1]))
