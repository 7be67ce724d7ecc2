"""fuzz_limits.py LUTETIA [SECONDS [SEED]]: a script takes no more memory and time than it was given, whatever it asks for.

Each case asks one function for as much as it can, again and again; then random programs of such calls do, under small --memory and
--timeout. All of the process that is in memory is the memory given and 64 MB at most, with the machine of papers, the driver and the compiler;
and it takes the time given and 2 seconds. (security.md 4)
"""
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import time
import zlib

BESIDES_MB, BESIDES_S = 64, 2.0
STUCK_S = 180  # of a busy machine, which gives it little
SLOWER = float(os.environ.get("LUTETIA_TEST_SLOWER", "1"))

# name, script; `keep` holds what was made. %d: a size by chance
CASES = [
    ("networks", "while true do keep[#keep + 1] = spring.network() end"),
    ("fonts", "while true do local n = spring.network() keep[#keep + 1] = n for _, f in ipairs{'DejaVuSans', 'DejaVuSerif', "
              "'DejaVuSansMono', 'EBGaramond12-Regular', 'NotoColorEmoji'} do pcall(n.word, n, {text = 'a', font = f}) end end"),
    ("letters", "while true do local w = spring.word{text = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz'} "
                "w:mask{scale = 400} keep[#keep + 1] = w end"),
    ("papers", "while true do keep[#keep + 1] = paper{width = 64, height = 64, pigments = {}} end"),
    ("brushes", "local p = paper{width = 16, height = 16} while true do keep[#keep + 1] = p:brush{number = 1, width = 90, bristles = 512} end"),
    ("pictures", "while true do keep[#keep + 1] = picture('bomb.png') end"),
    ("images", "while true do keep[#keep + 1] = image('bomb.png') end"),
    ("songs", "while true do keep[#keep + 1] = song('big.mid') end"),
    ("networks read", "while true do keep[#keep + 1] = spring.network('big.springs') end"),
    ("masks scaled", "local m = rect(0, 0, 200, 200) * 0.5 while true do m:scale(40) end"),
    ("masks turned", "local m = rect(0, 0, 5000, 5000) * 0.5 while true do m:rotate(45) end"),
    ("masks joined", "local m = rect(0, 0, 6000, 6000) * 0.5 while true do local n = m + m end"),
    ("masks counted", "local m = rect(0, 0, 6000, 6000) * 0.5 while true do local n = m * 0.5 end"),
    ("masks softened", "local m = rect(0, 0, 5000, 5000) * 0.5 while true do m:soften(900) end"),
    ("masks put", "local p = paper{width = 16, height = 16} local m = 1 - rect(0, 0, 9, 9) while true do p:put(m, {water = 0.1}) end"),
    ("polygons", "local c = {} for i = 1, 20000 do c[i] = {i * 7919 % 5000, i * 104729 % 5000} end "
                 "while true do local m = polygon(c) * 0.5 end"),
    ("lines", "local c = {} for i = 1, 20000 do c[i] = {i * 7919 % 3000, i * 104729 % 3000, 50} end while true do line(c) end"),
    ("pages", "page(('*a*'):rep(300000), {width = 600, height = 840, size = 10})"),
    ("words in pages", "page(('a marsh and '):rep(60000), {width = 600, height = 840, size = 4, hyphenate = true})"),
    ("marks in pages", "page(('*a'):rep(450000), {width = 600, height = 840, size = 10})"),
    ("flags in pages", "page(('\\u{1f1e6}'):rep(240000), {width = 600, height = 840, size = 10})"),
    ("lines of text", "while true do text(('a\\n'):rep(30000), {size = 1}) end"),
    ("long words", "spring.word{text = ('Lutetia '):rep(2400), width = 600}"),
    ("texts", "while true do text(('Lutetia '):rep(30000), {size = 20, width = 9000}) end"),
    ("large texts", "while true do text('Lutetia', {size = 3000}) end"),
    ("separations", "local p = paper{width = 16, height = 16, pigments = {'cyan', 'magenta', 'yellow'}} "
                    "local q = picture(400, 400, function(x, y) return x / 400, y / 400, x * y % 7 / 7 end) "
                    "while true do p:separate(q, {width = 2000, height = 2000}) end"),
    ("frames", "local p = paper{width = 700, height = 700} while true do p:frame('frame.png', {scale = 4}) end"),
    ("steps of papers", "local p = paper{width = 300, height = 300} while true do p:put(ellipse(150, 150, 100), {water = 1}) p:step(9) end"),
    ("steps of networks", "local n = spring.network() for i = 1, 3000 do n:mass{x = i, y = i % 7} end "
                          "for i = 2, 3000 do n:spring(i - 1, i) end n:step(1000000)"),
    ("words collide", "local w = spring.word{text = ('Lutetia '):rep(900), width = 20} w:collide(true) w:step(1000000)"),
    ("texts of Lua", "while true do keep[#keep + 1] = ('x'):rep(1000000) .. #keep end"),
    ("tables of Lua", "while true do keep[#keep + 1] = {} end"),
    ("coroutines", "while true do keep[#keep + 1] = coroutine.wrap(function() coroutine.yield() end) keep[#keep]() end"),
    ("numbers of objects", "while true do keep[#keep + 1] = tostring({}) end"),
    ("caught", "while true do pcall(function() while true do keep[#keep + 1] = spring.network() end end) end"),
]


# One thread computes, and each of its loops asks for the time: the watchdog need not end them.
ASKS = {"letters", "masks scaled", "masks turned", "masks joined", "masks counted", "masks softened", "polygons", "lines", "pages", "words in pages",
        "marks in pages", "flags in pages", "lines of text", "long words", "texts", "separations", "steps of networks"}
ENDED = "did not stop"
UNASKED_S = 0.5  # of the second after which the watchdog ends it


def png_chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def files_make(at):
    """A picture of some kilobytes that is 16,000 pixels wide and high; a song and a network as long as files may be."""
    side = 16000
    packer = zlib.compressobj(9)
    rows = b"".join(packer.compress(bytes(1 + side // 8)) for _ in range(side)) + packer.flush()
    (at / "bomb.png").write_bytes(b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 1, 0, 0, 0, 0)) +
                                  png_chunk(b"IDAT", rows) + png_chunk(b"IEND", b""))
    track = b"\x00\xc0\x05" + b"\x00\x05" * 4000000 + b"\x00\xff\x2f\x00"
    (at / "big.mid").write_bytes(b"MThd\0\0\0\6\0\0\0\1\0\x60MTrk" + struct.pack(">I", len(track)) + track)
    (at / "big.springs").write_text("springs 1\n" + "".join("mass x=%d y=%d mass=1\n" % (i % 1000, i // 1000) for i in range(300000)) +
                                    "".join("spring %d %d constant=9 damping=0.1\n" % (i, i + 1) for i in range(299999)) + "end\n")


def waited(child, until):
    """Waits for its end, or ends it then; returns the megabytes that it had in memory at most, and its processor's seconds."""
    while True:
        pid, status, used = os.wait4(child.pid, os.WNOHANG)
        if pid:
            child.returncode = os.waitstatus_to_exitcode(status)
            return used.ru_maxrss * 1024 / 1e6, used.ru_utime + used.ru_stime
        if time.monotonic() > until:
            child.kill()
        time.sleep(0.003)


def tried(lutetia, at, name, script, memory, timeout):
    """Runs it; returns what it took, in megabytes and seconds."""
    (at / "case.lua").write_text("keep = {}\n" + script + "\n")
    began = time.monotonic()
    with tempfile.TemporaryFile() as complaints:
        child = subprocess.Popen([lutetia, "run", "case.lua", "-q", "--memory", str(memory), "--timeout", str(timeout)], cwd=at,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=complaints)
        most, busy = waited(child, began + STUCK_S)
        complaints.seek(0)
        words = complaints.read().decode(errors="replace")
    took = time.monotonic() - began
    what = "%s: %s--memory %d --timeout %g: %.0f MB, %.1f s, processor %.1f s, status %s: %s" % (
        name, script + "\n" if name == "chance" else "", memory, timeout, most, took, busy, child.returncode, words.strip()[:200])
    assert child.returncode in (0, 1), what
    assert child.returncode == 0 or words.count("\n") == 1, what
    assert most <= memory * 1.048576 + BESIDES_MB, what
    # A busy machine may have given it nothing of that second.
    assert name not in ASKS or ENDED not in words or busy < timeout + UNASKED_S, "a loop does not ask for the time: " + what
    # A busy machine gives the process less than the time that passes; what runs in it takes two processors at most.
    assert took <= timeout + BESIDES_S * SLOWER or busy <= timeout + BESIDES_S, what
    return most, took


def refused_early(lutetia, at):
    """Where there is no room for the machine of papers that is said before it is loaded; with some more a paper is made."""
    for memory, words in ((30, b"papers need a machine"), (300, b"")):
        (at / "case.lua").write_text("local p = paper{width = 32, height = 32} p:step(1)\n")
        done = subprocess.run([lutetia, "run", "case.lua", "-q", "--memory", str(memory)], cwd=at, stdin=subprocess.DEVNULL,
                              capture_output=True, check=False)
        assert done.returncode == bool(words) and words in done.stderr and done.stderr.count(b"\n") == bool(words), done


def by_chance(chance):
    lines = []
    for _ in range(chance.randint(1, 5)):
        script = chance.choice(CASES)[1]
        if chance.random() < 0.6:
            script = script.replace("while true do", "for _ = 1, %d do" % chance.choice((1, 5, 40, 1000)), 1)
        lines.append("%s(function() %s end)" % (chance.choice(("pcall", "coroutine.wrap")), script))
        lines[-1] += "()" if lines[-1].startswith("coroutine") else ""
    return "\n".join(lines)


def main():
    lutetia = os.path.abspath(sys.argv[1])
    if b"__asan_init" in pathlib.Path(lutetia).read_bytes() or b"__tsan_init" in pathlib.Path(lutetia).read_bytes():
        print("skipped: a sanitizer takes memory and time of its own")
        sys.exit(77)
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 0
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 36)
    with tempfile.TemporaryDirectory(prefix="lutetia-limits-") as folder:
        at = pathlib.Path(folder)
        files_make(at)
        wrong = []
        if not seconds:
            refused_early(lutetia, at)
            for name, script in CASES:
                try:
                    memory = 400 if name in ASKS else 140 if "paper{" in script else 60  # those that ask end by their time, not before
                    print("%-20s %5.0f MB %5.1f s" % (name, *tried(lutetia, at, name, script, memory, 0.5)), flush=True)
                except AssertionError as error:
                    print(error, flush=True)
                    wrong.append(name)
        until, count = time.monotonic() + seconds, 0
        while time.monotonic() < until:
            count += 1
            try:
                tried(lutetia, at, "chance", by_chance(chance), chance.choice((30, 60, 120, 200, 300)), chance.choice((0.2, 0.5, 2)))
            except AssertionError as error:
                print(error, flush=True)
                wrong.append("program %d" % count)
        if seconds:
            print("%d programs, %d not within their limits" % (count, len(wrong)))
    sys.exit(", ".join(wrong) or 0)


if __name__ == "__main__":
    main()
