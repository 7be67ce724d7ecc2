"""test_libraries.py LUTETIA: libraries that the command loads when it needs them, each damaged in turn.

An empty file of the library's name lies before the real one on the loader's path. What needs it is then one line that names what is
missing and what to install, with status 1 and without an output; what can go without it is made another way.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

LUTETIA = os.path.abspath(sys.argv[1])
# (the file's name begins with; command line; words of the line, or None: it goes without; the output)
ROWS = (
    ("libcmark-gfm.so.", ("read", "a.md", "-o", "out.pdf"), ("cmark-gfm", "install"), "out.pdf"),
    ("libcmark-gfm-extensions.so.", ("read", "a.md", "-o", "out.png"), ("cmark-gfm", "install"), "out.png"),
    ("libhdf5", ("run", "a.lua", "-q", "-o", "."), ("HDF5", "cannot be loaded"), "a.h5"),
    ("libharfbuzz-subset.so.", ("type", "letters", "-o", "out.pdf"), None, "out.pdf"),
    ("libhyphen.so.", ("set", "a.md", "-o", "out.pdf"), None, "out.pdf"),
    ("libcmark-gfm.so.", ("set", "a.md", "-o", "out.pdf"), None, "out.pdf"),  # plain text
    ("libcmark-gfm.so.", ("--version",), None, None),
)

text = pathlib.Path(LUTETIA).read_bytes()
names = {name.decode() for name in re.findall(rb"lib[a-z][\w+-]*?(?:-[\d.]+)?\.so\.\d[\w.]*(?=\0)", text)}
linked = subprocess.run(["ldd", LUTETIA], check=True, capture_output=True, text=True).stdout
with tempfile.TemporaryDirectory(prefix="lutetia-libraries-") as folder:
    at = pathlib.Path(folder)
    (at / "a.md").write_text("# A title\n\nwords that are *set*\n")
    (at / "a.lua").write_text('local p = paper{width = 32, height = 32} p:step(1) p:save("a.h5")\n')
    for begin, words, said, output in ROWS:
        found = [name for name in names if name.startswith(begin)]
        if not found and begin.startswith("libcmark"):  # a distribution may not have it
            print("skipped: built without %s" % begin)
            continue
        assert len(found) == 1, (begin, found)
        assert found[0] not in linked, "%s is linked, where it takes time of every start" % found[0]
        damaged = at / "damaged" / found[0]
        damaged.mkdir(parents=True, exist_ok=True)
        (damaged / found[0]).touch()
        for path in (None, damaged):
            environment = dict(os.environ) if path is None else dict(os.environ, LD_LIBRARY_PATH=str(path))
            result = subprocess.run([LUTETIA, *words], cwd=at, env=environment, capture_output=True, text=True, timeout=600, check=False)
            good = path is None or said is None
            assert (result.returncode == 0) == good and result.returncode in (0, 1), (words, path, result)
            assert good or (result.stderr.count("\n") == 1 and all(word in result.stderr for word in said)), (words, result)
            if output:
                assert (at / output).exists() == good, (words, path, result)
                (at / output).unlink(missing_ok=True)
        print("%s without %s: %s" % (" ".join(words), found[0], "said" if said else "made"), flush=True)
