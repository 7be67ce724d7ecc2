"""test_films.py LUTETIA [all]: films on full disks, of each kind that ffmpeg writes.

A disk is a small tmpfs, which root alone can mount; else, and without ffmpeg, this test is skipped. Whatever is left on the disk, the
film is whole and the status 0, or the status tells, and the film before is as it was. (security.md 11, 18)
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
SECONDS = 60
ENDINGS = ("mp4", "mov", "mkv", "webm", "avi", "gif", "ogv")
OFTEN = ("mp4", "mkv", "gif")
PARTS = (0.3, 0.97, 1.02)  # of what a film takes is free
BLOCK = 4096


def filmed(lutetia, film, cwd):
    done = subprocess.run([lutetia, "voice", "--cry", "Ah", "--picture", "160x120", "--fps", "12", "--video", str(film)], cwd=cwd,
                          stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS, check=False)
    return done.returncode, done.stderr.decode(errors="replace")


def frames_of(film):
    """The pictures in a film, all decoded; -1: it is damaged."""
    done = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                           "stream=nb_read_frames", "-of", "csv=p=0", str(film)], capture_output=True, timeout=SECONDS, check=False)
    words = done.stdout.decode().strip().strip(",")
    return int(words) if done.returncode == 0 and not done.stderr and words.isdigit() else -1


def mount(folder, size):
    return subprocess.run(["mount", "-t", "tmpfs", "-o", "size=%d" % size, "none", str(folder)],
                          capture_output=True, check=False).returncode == 0


def tried(lutetia, at, ending, whole, frames, part):
    """One film with that part of its size free."""
    disk = at / "disk"
    what = "%s with %g of its %d bytes free" % (ending, part, whole)
    blocks = max(1, round(whole * part / BLOCK))
    assert mount(disk, (1 + blocks) * BLOCK), what
    try:
        film = disk / ("film." + ending)
        film.write_text("before")
        status, words = filmed(lutetia, film, at)
        assert status in (0, 1), (what, status, words)
        assert not list(disk.glob(".*.part")), what
        if status == 0:
            assert frames_of(film) == frames, (what, frames_of(film), frames)
        else:
            # the film's sound, which lies beside a .gif, may be what did not go onto the disk
            assert film.read_bytes() == b"before" or frames_of(film) == frames, (what, words, frames_of(film), frames)
            assert words.count("\n") >= 1, what
        return status
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def interrupted(lutetia, at):
    """A film that is ended early is whole, and its sound ends with its pictures."""
    film = at / "early.mp4"
    child = subprocess.Popen([lutetia, "spring", "early", "--preset", "jelly", "--video", str(film), "--seconds", "60", "--size", "320x240"],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until = time.monotonic() + SECONDS
    while not list(at.glob(".early.mp4.*.part")) and time.monotonic() < until:
        time.sleep(0.01)
    time.sleep(1)
    child.terminate()
    child.wait(timeout=SECONDS)
    assert frames_of(film) > 0, film
    done = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=duration", "-of", "csv=p=0", str(film)], capture_output=True,
                          timeout=SECONDS, check=True)
    lengths = [float(line.strip(",")) for line in done.stdout.decode().split()]
    assert 0 < lengths[0] < 59 and max(lengths) - min(lengths) < 0.2, lengths
    film.unlink()


def main():
    lutetia = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="lutetia-films-") as folder:
        at = pathlib.Path(folder)
        (at / "disk").mkdir()
        if not (shutil.which("ffmpeg") and shutil.which("ffprobe")):
            print("skipped: there is no ffmpeg")
            sys.exit(SKIPPED)
        interrupted(lutetia, at)
        if os.geteuid() != 0 or not mount(at / "disk", 65536):
            print("skipped: this user cannot mount a disk")
            sys.exit(SKIPPED)
        subprocess.run(["umount", str(at / "disk")], check=True)
        whole = full = 0
        for ending in ENDINGS if sys.argv[2:] == ["all"] else OFTEN:
            film = at / ("film." + ending)
            status, words = filmed(lutetia, film, at)
            assert status == 0, (ending, words)
            frames = frames_of(film)
            assert frames > 3, (ending, frames)
            for part in PARTS:
                failed = tried(lutetia, at, ending, film.stat().st_size, frames, part)
                full += failed
                whole += not failed
        assert full >= len(OFTEN), full
        print("%d films whole, %d disks full" % (whole, full))


if __name__ == "__main__":
    main()
