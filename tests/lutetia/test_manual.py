"""test_manual.py LUTETIA BUILD CMARK: the manual as it is installed, which `lutetia read` opens where no file is named.

Only the manual is installed, into a folder of its own, and the command beside it. All of its files and pictures are there; it is set as a page;
a chapter that is missing, or a list that is damaged or missing, is one line and status 1. CMARK: "reads", or "reads-not" without cmark-gfm.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

LUTETIA, BUILD, READS = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3] == "reads"
FENCE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)  # what is shown as it is written
PICTURE = re.compile(r"^!\[[^\]]*\]\(([^):]+\.png)\)$", re.MULTILINE)


def read(command, where, *options):
    return subprocess.run([command, "read", *options], cwd=where, capture_output=True, text=True, check=False)


def says(ended, *words):
    assert ended.returncode == 1, ended
    assert ended.stderr.count("\n") == 1 and all(word in ended.stderr for word in words), ended.stderr


with tempfile.TemporaryDirectory(prefix="lutetia-manual-") as folder:
    at = pathlib.Path(folder)
    subprocess.run(["meson", "install", "-C", BUILD, "--no-rebuild", "--quiet", "--tags", "manual", "--destdir", at / "to"],
                   check=True, stdout=subprocess.DEVNULL)
    (listed,) = (at / "to").rglob("manual.txt")
    manual = listed.parent
    prefix = manual.parents[2]  # of share/lutetia/manual
    (prefix / "bin").mkdir()
    command = shutil.copy2(LUTETIA, prefix / "bin")
    chapters = listed.read_text().split()
    assert len(chapters) > 30 and len(set(chapters)) == len(chapters), chapters
    pictures = 0
    for chapter in chapters:
        text = FENCE.sub("", (manual / chapter).read_text())
        for picture in PICTURE.findall(text):
            assert (manual / chapter).parent.joinpath(picture).is_file(), (chapter, picture)
            pictures += 1
    assert pictures > 50, pictures
    if READS:
        page = at / "page.png"
        ended = read(command, at, "--paper", "400x560", "--size", "12", "-o", page)
        assert ended.returncode == 0 and page.read_bytes().startswith(b"\x89PNG"), ended
        html = at / "manual.html"
        ended = read(command, at, "--theme", "dark", "-o", html)
        assert ended.returncode == 0 and html.read_text().count("src=\"data:image/png;base64,") > 50, ended
        for name, more in (("page.png", ["--remarks"]), ("x.pdf", ["--theme", "dark"]), ("x.html", ["--page", "2"])):
            ended = read(command, at, *more, "-o", at / name)  # each is for others
            assert ended.returncode == 2 and more[0] + " has no effect" in ended.stderr, ended
    # damaged
    (manual / chapters[1]).unlink()
    says(read(command, at, "-o", at / "no.pdf"), chapters[1])
    listed.write_text("README.md\n" * 100)
    says(read(command, at, "-o", at / "no.pdf"), "manual.txt", "damaged")
    listed.unlink()
    says(read(command, at, "-o", at / "no.pdf"), "not installed", "name a Markdown file")
    assert not (at / "no.pdf").exists()
