"""debugger.py - what tests of `lutetia debug` share."""
import os
import re
import shutil
import subprocess
import tempfile

# As a user has it: small programs are interpreted, and no kernel is compiled.
ENVIRONMENT = {k: v for k, v in os.environ.items() if k != "LUTETIA_INTERPRET"} | {"LC_ALL": "C.UTF-8", "DEBUGINFOD_URLS": "", "LUTETIA_TUNED": "0"}

# gdb's own lines, which differ between versions and computers.
NOISE = re.compile(r"\[Thread|Using host libthread_db|Breakpoint \d+ at|\[Inferior|\[New Thread|\[Detaching|warning: |Downloading |"
                   r"This GDB supports|Enable debuginfod|Debuginfod has|To make this setting|\s*$|"
                   r"A debugging session is active|Inferior \d+ \[process|Quit anyway")


def missing():
    """Why gdb cannot be used here; None: it can."""
    if not shutil.which("gdb"):
        return "gdb is not installed"
    with tempfile.TemporaryDirectory() as folder:
        tried = subprocess.run(["gdb", "-q", "-batch", "-nx", "-ex", "python print('has python')", "-ex", "run", "--args", "/bin/true"],
                               cwd=folder, capture_output=True, text=True, timeout=120, check=False)
    if "has python" not in tried.stdout:
        return "gdb has no Python"
    if "exited normally" not in tried.stdout:
        return "processes cannot be traced here (ptrace)"
    return called()


def called():
    """Why gdb cannot call functions of a program here; None: it can. gdb before 14 cannot on processors with AMX."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "two")
        subprocess.run(["cc", "-g", "-x", "c", "-", "-o", path], input="int two(void) { return 2; }\nint main(void) { return two() - 2; }\n", text=True,
                       timeout=120, check=True)
        tried = subprocess.run(["gdb", "-q", "-batch", "-nx", "-ex", "break main", "-ex", "run", "-ex", "print two()", path],
                               cwd=folder, capture_output=True, text=True, timeout=120, check=False)
    return "this gdb cannot write registers of this processor (gdb 14 can)" if "extended state" in tried.stderr else None


def own_lines(text):
    """What is said without gdb's own lines; breakpoints are hit by threads or not."""
    return [re.sub(r'^Thread \d+ "[^"]*" hit ', "", line.rstrip()) for line in text.splitlines() if not NOISE.match(line)]
