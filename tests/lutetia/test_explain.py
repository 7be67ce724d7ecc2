#!/usr/bin/env python3
"""Tests LUTETIA_TRACE, LUTETIA_EXPLAIN and `lutetia explain` as a user runs them.

    test_explain.py LUTETIA EXPLAINED SOURCE

EXPLAINED is the program explained.c, whose kernels and bytes are known by hand.
"""
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

LUTETIA, EXPLAINED, SOURCE = sys.argv[1:4]
STEPS, PROCESSORS = 25, 32 * 512
NAMES = ("LUTETIA_TRACE", "LUTETIA_EXPLAIN", "LUTETIA_EXPLAIN_JSON", "LUTETIA_EAGER", "LUTETIA_REPLAY")


def run(*command, **variables):
    environment = {k: v for k, v in os.environ.items() if k not in NAMES} | variables
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=200)


def one_line(text, *words):
    """Checks that an error is one line that contains these words."""
    assert text.count("\n") == 1 and text.endswith("\n"), repr(text)
    for word in words:
        assert word in text, (word, text)


def load_cut(path):
    """The events of a file whose program was killed: the closing bracket may be missing."""
    text = open(path).read()
    return json.loads(text if text.rstrip().endswith("]") else text + "\n]")


def nested(events, track):
    """Checks that a track's spans lie beside or within each other. Returns {index: index of the span around it}."""
    spans = sorted((e for e in events if e["ph"] == "X" and e["tid"] == track),
                   key=lambda e: (round(e["ts"] * 1000), -round(e["dur"] * 1000)))
    around, parents = [], []
    for e in spans:
        start, end = round(e["ts"] * 1000), round(e["ts"] * 1000) + round(e["dur"] * 1000)
        assert start >= 0 and end >= start
        while around and around[-1][1] <= start:
            around.pop()
        if around:
            assert end <= around[-1][1], (e, around[-1][2])
        parents.append((e, around[-1][2]["name"] if around else None))
        around.append((start, end, e))
    return parents


def named(events, name):
    return [e for e in events if e["name"] == name]


def trace_has_every_part_in_its_place(folder):
    path = f"{folder}/trace.json"
    began = time.monotonic()
    result = run(EXPLAINED, str(STEPS), LUTETIA_TRACE=path)
    took_us = (time.monotonic() - began) * 1e6
    assert result.returncode == 0 and result.stderr == "", result
    events = json.load(open(path))
    assert {e["args"]["name"] for e in named(events, "thread_name")} == {"front end", "device"}
    assert len(named(events, "process_name")) == 1
    for e in events:
        assert e["ph"] in "XiM" and e["pid"] == 1
        if e["ph"] == "X":
            assert e["ts"] + e["dur"] <= took_us, e

    front, device = nested(events, 1), nested(events, 2)
    # Each instruction, and each step, was either recorded or foreseen and performed at once.
    evaluations = [e for e, _ in front if e["name"] == "evaluate"]
    replays = [e for e, _ in front if e["name"] == "replay"]
    recorded = named(events, "CM_f_add_2_1L")
    assert len(evaluations) + len(replays) == STEPS and replays and evaluations
    assert len(recorded) + sum(e["args"]["calls"] for e in replays) == STEPS
    assert len(named(events, "CM_f_read_from_processor_1L")) == STEPS
    assert all(e["args"]["why"] == "looked at" for e in evaluations)
    parents = {}
    for e, parent in front:
        parents.setdefault(e["name"], set()).add(parent)
    assert parents["CM_f_add_2_1L"] == {None}
    assert parents["note calls"] == {None}
    assert parents["replay"] == {None}
    assert parents["targets"] == parents["signature"] == parents["plan look-up"] == {"evaluate"}
    assert parents["plan"] == {"plan look-up"} and parents["generate"] == {"plan look-up"}
    assert parents["launch"] == {"evaluate", "replay"}
    assert any(name.startswith("build") and "plan look-up" in around for name, around in parents.items())
    assert sum(e["name"] == "writing a field" and e["args"]["bytes"] >= 4 * PROCESSORS for e, _ in front) == 2
    looks = [e for e, _ in front if e["name"] == "reading a processor"]
    assert len(looks) == STEPS and all(e["args"]["bytes"] == 4 and e["cat"] == "wait" for e in looks)

    kernels = [e for e, _ in device] + [e for e in events if e["ph"] == "i" and e["tid"] == 2]
    assert len(kernels) == STEPS
    for e in kernels:
        assert re.fullmatch(r"field \d+ = FADD", e["name"]), e
        assert e["args"]["processors"] == PROCESSORS and e["args"]["operations a processor"] == 1
        assert e["args"]["bytes read"] == 8 * PROCESSORS and e["args"]["bytes written"] == 4 * PROCESSORS
    # A step's kernel ends before the read that waits for it; the clocks agree to a tenth of a millisecond.
    if device:
        ends = sorted(e["ts"] + e["dur"] for e, _ in device)
        for end, look in zip(ends, sorted(looks, key=lambda e: e["ts"])):
            assert end <= look["ts"] + look["dur"] + 100, (end, look)


def trace_of_two_machines_is_one_file(folder):
    path = f"{folder}/two.json"
    result = run(EXPLAINED, "twice", LUTETIA_TRACE=path)
    assert result.returncode == 0 and result.stderr == "", result
    events = json.load(open(path))
    assert {e["pid"] for e in events} == {1, 2}
    for machine in 1, 2:
        assert sum(e["pid"] == machine and e["name"] == "evaluate" for e in events) == 1


def start_forever(*command, **variables):
    environment = {k: v for k, v in os.environ.items() if k not in NAMES} | variables
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               start_new_session=True)
    assert process.stdout.readline() == "running\n"
    time.sleep(0.2)
    return process


def killed_program_leaves_a_trace(folder):
    path = f"{folder}/killed.json"
    process = start_forever(EXPLAINED, "forever", LUTETIA_TRACE=path)
    process.kill()
    process.communicate()
    events = load_cut(path)
    assert len(named(events, "reading a processor")) >= 1
    assert json.load(open(path)), "the file has its bracket at any moment but that of a write"
    nested(events, 1), nested(events, 2)


def trace_that_cannot_be_written_is_said_once(folder):
    for path, why in ((f"{folder}/no/such/trace.json", "No such file"), ("/dev/full", "No space")):
        for mode in "3", "twice":
            result = run(EXPLAINED, mode, LUTETIA_TRACE=path)
            assert result.returncode == 1 and result.stdout.startswith("water "), result
            one_line(result.stderr, "LUTETIA_TRACE", path, why)


def explanation(folder, *command):
    path = f"{folder}/explained.json"
    result = run(LUTETIA, "explain", "--json", path, *command)
    return result, json.load(open(path))["machines"]


def explanation_is_exact(folder):
    result, machines = explanation(folder, EXPLAINED, str(STEPS))
    assert result.returncode == 0 and result.stderr == "", result
    assert result.stdout.startswith(f"water {0.5 * STEPS:.1f}\n")
    assert len(machines) == 1
    x = machines[0]
    calls = {row["name"]: row for row in x["calls"]}
    assert calls["CM_f_add_2_1L"]["count"] + calls["CM_f_add_2_1L"]["foreseen"] == STEPS
    assert calls["CM_f_add_2_1L"]["foreseen"] == x["calls_foreseen"] >= STEPS - 4
    assert calls["CM_f_read_from_processor_1L"]["count"] == STEPS
    assert calls["CM_f_write_to_news_array_1L"]["count"] == 2
    kernels = x["kernels"]
    assert sum(k["runs"] for k in kernels) == STEPS
    assert sum(k["bytes"] for k in kernels) == STEPS * PROCESSORS * 12
    for k in kernels:
        assert k["generated"] and k["processors"] == PROCESSORS
        assert (k["bytes_read"], k["bytes_written"], k["operations"]) == (8, 4, 1)
        assert (k["arrays_read"], k["arrays_written"]) == (2, 1)
        (stored,) = k["stores"]
        assert (stored["operation"], stored["type"], stored["why"]) == ("FADD", "f32", "looked at")
        plan = k["plan"]
        assert plan["chosen"] == "in rows" and not plan["forced"] and "in tiles" not in plan["costs_s"]
        assert 0 < k["predicted_s"] <= plan["costs_s"]["in rows"] * 1.0001 < 1
        if k["runs_timed"]:
            assert 0 < k["time_s"] < 100 and 0 < k["copy_s"] < 10 and k["bound_s"] >= k["copy_s"]
    evaluated = {row["name"]: row["count"] for row in x["evaluated_because"]}
    assert evaluated["somebody looked"] == STEPS and sum(evaluated.values()) == STEPS
    assert x["values_vanished"] == 0
    built = sum(row["count"] for row in x["phases"] if row["name"] in ("build: compile", "build: from the disk cache"))
    assert built == len(kernels) and x["plans_built"] >= 1
    waits = {row["name"]: row for row in x["waits"]}
    assert (waits["reading a processor"]["count"], waits["reading a processor"]["bytes"]) == (STEPS, 4 * STEPS)
    for wanted in (rf"{STEPS} run|{kernels[0]['runs']} run", "each reads 8 bytes .2 arrays., writes 4", "= FADD",
                   "CM_f_add_2_1L", "1 operations", "somebody looked", "predicted [0-9.]+ us", "of a plan in rows, [0-9.]+ us"):
        assert re.search(wanted, result.stdout), wanted


def explanation_of_two_machines(folder):
    result, machines = explanation(folder, EXPLAINED, "twice")
    assert result.returncode == 0, result
    assert [sum(k["runs"] for k in x["kernels"]) for x in machines] == [1, 1]
    assert result.stdout.count("a machine of ") == 2


def explanation_of_a_source(folder):
    result, machines = explanation(folder, SOURCE, "3")
    assert result.returncode == 0, result
    assert result.stdout.startswith("water 1.5\n")
    assert sum(k["runs"] for k in machines[0]["kernels"]) == 3


def interrupted_program_explains_itself(folder):
    process = start_forever(LUTETIA, "explain", EXPLAINED, "forever", LUTETIA_BACKGROUND="1")
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does
    output, errors = process.communicate(timeout=100)
    assert process.returncode == 130 and errors == "", (process.returncode, errors)
    assert "somebody looked" in output and "= FADD" in output


def folder_with_a_text(folder):
    inner = f"{folder}/texts"
    os.makedirs(inner, exist_ok=True)
    open(f"{inner}/junk.c.txt", "w").write("no program\n")
    return inner


def wrong_arguments_are_one_line(folder):
    junk = f"{folder}/junk.c"
    open(junk, "w").write("int main( {\n")
    texts = folder_with_a_text(folder)
    before = set(os.listdir(folder))
    for status, words, *arguments in (
            (2, ("no program",)),
            (2, ("--bogus", "--help"), "--bogus", EXPLAINED),
            (2, ("--json", "value"), "--json"),
            (1, ("/no/such/program", "cannot run"), "/no/such/program"),
            (1, ("/no/such/source.c", "cannot read"), "/no/such/source.c"),
            (1, ("/no/such/x.json", "cannot write"), "--json", "/no/such/x.json", EXPLAINED, "1"),
            (1, (EXPLAINED, "nothing to explain"), EXPLAINED, "nothing"),
            (1, ("/bin/true", "nothing to explain"), "/bin/true")):
        result = run(LUTETIA, "explain", *arguments, TMPDIR=folder)
        assert result.returncode == status and result.stdout == "", (arguments, result)
        one_line(result.stderr, *words)
    # A file of this folder that is no program, named without the folder.
    result = subprocess.run([os.path.abspath(LUTETIA), "explain", "junk.c.txt"], cwd=texts, capture_output=True,
                            text=True, timeout=200)
    assert result.returncode == 1 and result.stdout == "", result
    one_line(result.stderr, "junk.c.txt", "cannot run", "ermission")
    result = run(LUTETIA, "explain", junk, TMPDIR=folder)
    assert result.returncode == 1 and "does not compile" in result.stderr.splitlines()[-1]
    result = run(LUTETIA, "explain", EXPLAINED, "1", "3", TMPDIR=folder)
    assert result.returncode == 1 and "= FADD" in result.stdout
    one_line(result.stderr, "status 3")
    assert set(os.listdir(folder)) == before, "something was left behind"
    result = run(EXPLAINED, "1", LUTETIA_EXPLAIN=f"{folder}/no/such/file")
    assert result.returncode == 1 and result.stdout == "water 0.5\n"
    one_line(result.stderr, "LUTETIA_EXPLAIN", "No such file")


def killed_program_leaves_nothing(folder):
    """A program that is ended by SIGKILL, or by the second of two signals, leaves its part files in explain's folder."""
    kept = f"{folder}/kept"
    os.makedirs(kept)
    for number in ("KILL", "TERM"):
        result = run(LUTETIA, "explain", "/bin/sh", "-c",
                     'for of in "$LUTETIA_EXPLAIN" "$LUTETIA_EXPLAIN_JSON"; do '
                     'echo >"${of%%/*}/.${of##*/}.0123456789abcdef.part"; done; kill -%s $$' % number, TMPDIR=kept)
        assert result.returncode == 1, result
        one_line(result.stderr, "ended by signal")
        assert os.listdir(kept) == [], os.listdir(kept)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for test in (trace_has_every_part_in_its_place, trace_of_two_machines_is_one_file,
                     killed_program_leaves_a_trace, trace_that_cannot_be_written_is_said_once, explanation_is_exact,
                     explanation_of_two_machines, explanation_of_a_source, interrupted_program_explains_itself,
                     killed_program_leaves_nothing, wrong_arguments_are_one_line):
            began = time.monotonic()
            test(folder)
            print(f"{test.__name__}: {time.monotonic() - began:.2f} s", flush=True)


main()
