"""How painting ends: Ctrl-C keeps what there was, and on a terminal the end says which files there are.

usage: test_ends.py LUTETIA FOLDER
(security.md 2: a run that is stopped writes its papers into the folder given)
"""
import os
import pty
import shutil
import signal
import subprocess
import sys

lutetia, folder = (os.path.abspath(a) for a in sys.argv[1:3])
shutil.rmtree(folder, ignore_errors=True)
os.makedirs(folder)

PAINTED = """local p = paper{width = 32, height = 24, pigments = {'ultramarine'}}
p:put(ellipse(10, 8, 5), {water = 0.8, ultramarine = 1})
p:step(30)
print('ready')
while param('loop', false) do end
p:step(20)
p:frame('end.png', {bits = 16})
"""


def must(good, what):
    if not good:
        sys.exit(f"test_ends.py: {what}")


def script(name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def run(*words):
    return subprocess.run([lutetia, *words], cwd=folder, capture_output=True, text=True, timeout=200)


def stopped(*words, send=signal.SIGINT, env=None):
    """Runs it, sends the signal once it says that it is ready, and gives its lines."""
    with subprocess.Popen([lutetia, *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=env) as child:
        must(child.stdout.readline() == "ready\n", f"{words}: not ready")
        child.send_signal(send)
        lines = child.communicate(timeout=200)[1].splitlines()
    must(child.returncode == 130, f"{words}: {child.returncode} {lines}")
    return lines


def there(name):
    return os.path.exists(os.path.join(folder, name))


def same(first, second):
    with open(os.path.join(folder, first), "rb") as one, open(os.path.join(folder, second), "rb") as other:
        return one.read() == other.read()


def kept():
    """The papers are beside the pictures, and the bits of the run that goes on are those of one that was never stopped."""
    script("kept.lua", PAINTED)
    for send in (signal.SIGINT, signal.SIGTERM):
        name = f"kept{int(send)}"
        state = f"{name}/kept-interrupted.h5"
        lines = stopped("run", "kept.lua", "-q", "-o", name, "loop=true", send=send)
        must(len(lines) == 2 and lines[0].startswith("kept.lua:") and lines[0].endswith(": interrupted"), lines)
        must(lines[1] == f"lutetia run: what there was is kept in {state}; the same command with --resume {state} goes on", lines)
        must(os.listdir(os.path.join(folder, name)) == ["kept-interrupted.h5"], os.listdir(os.path.join(folder, name)))
        done = run("run", "kept.lua", "-q", "-o", name, "--resume", state)
        must((done.returncode, done.stderr) == (0, ""), done.stderr)
        must(run("run", "kept.lua", "-q", "-o", "whole").returncode == 0, "the whole run")
        must(same(f"{name}/end.png", "whole/end.png"), "another picture than that of a run that was not stopped")
    must(os.listdir(os.path.join(folder, "whole")) == ["end.png"], "a run that comes to its end keeps nothing")


def kept_at_work():
    """Stopped while a step's kernels are compiled, it waits for them."""
    script("cold.lua", "local p = paper{width = 64, height = 48, pigments = {'ultramarine'}}\np:put(ellipse(30, 20, 9), {water = 1, ultramarine = 1})\n"
           "print('ready')\np:step(100000)\n")
    env = dict(os.environ, XDG_CACHE_HOME=os.path.join(folder, "caches"))
    env.pop("POCL_CACHE_DIR", None)
    lines = stopped("run", "cold.lua", "-q", "-o", "cold", env=env)
    must(len(lines) == 2 and "kept in cold/cold-interrupted.h5" in lines[1], lines)


def kept_again():
    """Stopped again before it has come to all of its papers, it leaves the state that it was resumed from."""
    script("two.lua", "local wait = param('wait', 0)\nfor i = 1, 2 do\n  local p = paper{width = 24, height = 16, pigments = {'cyan'}}\n"
           "  p:wash{water = 0.3, cyan = 0.1 * i}\n  _G['p' .. i] = p\n  if wait == i then print('ready') while true do end end\nend\n")
    state = "two/two-interrupted.h5"
    must("kept in" in stopped("run", "two.lua", "-q", "-o", "two", "wait=2")[1], "two papers")
    shutil.copy(os.path.join(folder, state), os.path.join(folder, "before.h5"))
    lines = stopped("run", "two.lua", "-q", "-o", "two", "wait=1", "--resume", state)
    must(len(lines) == 1 and same(state, "before.h5"), lines)


def not_kept():
    """Where nothing was done, where --save names a file, in a sweep, and where there is no room."""
    script("idle.lua", "local p = paper{width = 24, height = 16}\nprint('ready')\nwhile true do end\n")
    lines = stopped("run", "idle.lua", "-q", "-o", "idle")
    must(len(lines) == 1 and not os.listdir(os.path.join(folder, "idle")), lines)
    stopped("run", "kept.lua", "-q", "-o", "saved", "loop=true", "--save", "saved.h5")
    must(there("saved.h5") and not os.listdir(os.path.join(folder, "saved")), "--save")
    stopped("run", "kept.lua", "-q", "-o", "swept", "--sweep", "loop=true")
    must(not os.listdir(os.path.join(folder, "swept/loop-true")), "a sweep")
    os.makedirs(os.path.join(folder, "taken/kept-interrupted.h5"))
    lines = stopped("run", "kept.lua", "-q", "-o", "taken", "loop=true")
    must(len(lines) == 2 and "what there was is not kept: " in lines[1] and "taken/kept-interrupted.h5" in lines[1], lines)


def on_terminal(*words):
    """What is said on a terminal, without the line of progress."""
    top, low = pty.openpty()
    with subprocess.Popen([lutetia, *words], cwd=folder, stdout=low, stderr=low, stdin=subprocess.DEVNULL) as child:
        os.close(low)
        said = b""
        while True:
            try:
                part = os.read(top, 4096)
            except OSError:  # its end, on Linux
                break
            if not part:
                break
            said += part
    os.close(top)
    must(child.returncode == 0, f"{words}: {child.returncode} {said}")
    return [line for line in said.decode().replace("\x1b[K", "").replace("\r", "\n").split("\n") if "wrote" in line]


def told():
    """On a terminal alone, without -q."""
    script("told.lua", "local p = paper{width = 16, height = 16, model = 'thesis'}\n"
           "for i = 1, param('count', 1) do p:frame('a' .. i .. '.png') p:frame('a1.png') end\n")
    for count, says in ((1, "told/a1.png"), (2, "told/a1.png, told/a2.png"), (3, "told/a1.png, told/a2.png, told/a3.png"),
                        (5, "told/a1.png, told/a2.png, told/a3.png and others, the last one told/a5.png")):
        words = ["run", "told.lua", "-o", "told", f"count={count}"]
        must(on_terminal(*words) == [f"lutetia run: wrote {says}"], on_terminal(*words))
    must(on_terminal(*words, "-q") == [] and on_terminal("run", "told.lua", "-o", "told", "count=0") == [], "nothing to say")
    must(run(*words).stderr == "", "in a pipe")
    paint = ["paint", "L", "--paper", "32x24", "--steps", "2", "-o", "p.png"]
    must(on_terminal(*paint) == ["lutetia paint: wrote p.png"], on_terminal(*paint))
    must(on_terminal(*paint, "--frames", "f") == ["lutetia paint: wrote p.png, and pictures in f"], on_terminal(*paint, "--frames", "f"))
    done = run(*paint)
    must((done.returncode, done.stdout, done.stderr) == (0, "", ""), done.stderr)


kept()
kept_at_work()
kept_again()
not_kept()
told()
