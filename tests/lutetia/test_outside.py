"""test_outside.py LUTETIA: what comes from outside, and what is written, beside pictures and scripts.

Servers whose replies hold escapes, links and files in the place of the server's links and sounds, pipes and devices as maps and
SoundFonts, drawings with a DOCTYPE, text that XML has not, a compiler's long options, Ctrl-C while a song is rendered.
(security.md 5, 6, 7, 11, 12, 20, 21, 22, 28, 29)
"""
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "midi"))
import wire  # pylint: disable=wrong-import-position

LUTETIA = ""
SECONDS = 120
BAD = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80\xae")
SONG = b"MThd\0\0\0\6\0\0\0\1\0\x60MTrk\0\0\0\x0c\0\x90\x3c\x40\x60\x80\x3c\x40\0\xff\x2f\0"
TOKEN = b"x"
ESCAPES = b"\x1b]0;owned\x07\x1b[31mred\x9b31m\xc2\x9b31m\xe2\x80\xaeabc"


class EvilServer:
    """Speaks the protocol of the MIDI server to one client after another, and knows the token; all of its texts hold escapes."""

    def __init__(self):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        while True:
            try:
                client = self.listener.accept()[0]
            except OSError:
                return
            threading.Thread(target=self.answer, args=(client,), daemon=True).start()

    def answer(self, client):
        hello = challenge = b""
        for kind, payload, number in wire.Frames(client):
            if kind == wire.HELLO:
                hello, challenge = payload, wire.nonce()
                client.sendall(wire.frame(wire.CHALLENGE, challenge))
            if kind == wire.PROOF:
                proof = wire.code(TOKEN, b"server", self.port, hello, challenge)
                client.sendall(wire.frame(wire.WELCOME, b"lutetia-midi 2\n" + proof) +
                               wire.frame(wire.DEVICE, ESCAPES + b" loop in,out up", device=0))
            if kind == wire.COMMAND:
                client.sendall(wire.frame(wire.REPLY, ESCAPES + b" out up\n" + b"\xc2\x9b" * 3000 + b"\n", number=number))
                if payload.startswith(b"listen"):
                    client.sendall(wire.frame(wire.LOST, number=3) + wire.frame(wire.ERROR, ESCAPES))
                    client.close()
                    return


class Outside(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="lutetia-outside-")
        self.at = pathlib.Path(self.folder.name)
        (self.at / "song.mid").write_bytes(SONG)

    def tearDown(self):
        self.folder.cleanup()

    def run_it(self, *arguments, status=None, **variables):
        done = subprocess.run([LUTETIA, *arguments], cwd=self.at, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS,
                              check=False, env=dict(os.environ, **variables))
        if status is not None:
            self.assertEqual(done.returncode, status, done.stderr)
        self.assertIsNone(BAD.search(done.stdout + done.stderr), done.stdout + done.stderr)
        return done

    def refused(self, *arguments, status=1, **variables):
        done = self.run_it(*arguments, status=status, **variables)
        self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
        return done.stderr

    def test_replies_do_nothing_to_the_terminal(self):
        server = EvilServer()
        for verb in ("devices", "status"):
            done = self.run_it("midi", verb, "--server", "127.0.0.1:%d" % server.port, LUTETIA_MIDI_TOKEN=TOKEN.decode(), status=0)
            self.assertIn(b"out up", done.stdout)
            self.assertIn(rb"\x1b", done.stdout)
        for verb in (["record", "r.mid"], ["monitor"]): # the server is gone at once, and says why
            done = self.run_it("midi", *verb, "--server", "127.0.0.1:%d" % server.port, "-t", "0.5", LUTETIA_MIDI_TOKEN=TOKEN.decode())
            self.assertIn(rb"\x1b", done.stdout + done.stderr)
        server.listener.close()

    def serve(self, device):
        child = subprocess.Popen([LUTETIA, "midi", "serve", device, "--server", "./s", "--usual-priority", "--may-sleep"], cwd=self.at,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return child, self.listening(child)

    @staticmethod
    def listening(child):
        """What the server says until it listens, or ends."""
        words = b""
        for line in child.stdout:
            words += line
            if b"listening" in line:
                break
        return words

    def end(self, child):
        child.terminate()
        words = child.communicate(timeout=SECONDS)[0]
        return child.returncode, words

    def test_strangers_take_no_places(self):
        with socket.create_server(("127.0.0.1", 0)) as listener:
            port = listener.getsockname()[1]
        child = subprocess.Popen([LUTETIA, "midi", "serve", "loop", "--server", "./s", "--tcp", str(port), "--usual-priority",
                                  "--may-sleep"], cwd=self.at, env=dict(os.environ, LUTETIA_MIDI_TOKEN="known"),
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertIn(b"listening", self.listening(child))
        strangers = [socket.create_connection(("127.0.0.1", port)) for _ in range(300)]
        self.run_it("midi", "status", "--server", "./s", status=0)
        self.run_it("midi", "status", "--server", "127.0.0.1:%d" % port, LUTETIA_MIDI_TOKEN="known", status=0)
        self.run_it("midi", "status", "--server", "127.0.0.1:%d" % port, LUTETIA_MIDI_TOKEN="guessed", status=1)
        for stranger in strangers:
            stranger.close()
        self.assertEqual(self.end(child)[0], 0)

    def test_links_that_are_not_the_servers_stay(self):
        (self.at / "data").write_text("data")
        os.symlink("data", self.at / "link")
        self.end(self.serve("x=pty:link")[0])
        self.assertEqual(os.readlink(self.at / "link"), "data")
        self.assertEqual((self.at / "data").read_text(), "data")
        # its own it makes, replaces after a server that was killed, and removes; but not a file that has come in its place
        os.symlink("/dev/pts/999", self.at / "own")
        child, _ = self.serve("x=pty:own")
        self.assertTrue(os.readlink(self.at / "own").startswith("/dev/pts/"))
        self.end(child)
        self.assertFalse(os.path.lexists(self.at / "own"))
        child, _ = self.serve("x=pty:own")
        (self.at / "own").unlink()
        (self.at / "own").write_text("mine")
        self.end(child)
        self.assertEqual((self.at / "own").read_text(), "mine")

    def test_a_servers_sound_follows_no_link(self):
        os.symlink("target", self.at / "link.wav")
        os.mkfifo(self.at / "pipe.wav")
        for name in ("link.wav", "pipe.wav"):
            child, words = self.serve("x=sound:" + name)
            if b"FluidSynth" in words or b"SoundFont" in words:
                self.skipTest("there is no synthesizer")
            self.assertIn(b"cannot write", words)
            child.communicate(timeout=SECONDS)
            self.assertEqual(child.returncode, 1)
        self.assertFalse((self.at / "target").exists())

    def test_pipes_and_devices_are_neither_maps_nor_soundfonts(self):
        os.mkfifo(self.at / "pipe")
        for name in ("pipe", "/dev/zero", "/etc"):
            self.refused("keys", "song.mid", "--map", name, "-o", "p.png")
            self.refused("midi", "render", "song.mid", "--soundfont", name, "-o", "p.wav")
            for verb in (("midi", "render", "song.mid", "-o", "p.wav"), ("keys", "song.mid", "--sound", "p.wav", "-o", "p.png")):
                said = self.refused(*verb, LUTETIA_SOUNDFONT=name)
                self.assertRegex(said, b"(?i)not a regular file|directory")

    def test_a_long_option_names_the_program(self):
        (self.at / "p.c").write_text("int main(void) { return 0; }\n")
        for option in (["--output=prog"], ["--output", "prog"], ["-oprog"], ["-o", "prog"]):
            (self.at / "a.out").write_text("precious")
            self.run_it("cc", "p.c", *option, status=0)
            self.assertEqual((self.at / "a.out").read_text(), "precious")
            (self.at / "prog").unlink()

    def test_traces_follow_no_link(self):
        (self.at / "precious").write_text("precious")
        os.symlink("precious", self.at / "link")
        self.run_it("paint", "A", "--steps", "1", "--paper", "32x32", "-o", "t.png", LUTETIA_TRACE="link")
        self.assertEqual((self.at / "precious").read_text(), "precious")
        self.run_it("paint", "A", "--steps", "1", "--paper", "32x32", "-o", "t.png", LUTETIA_TRACE="trace", status=0)
        self.assertTrue((self.at / "trace").read_text().startswith("["))

    def recording_make(self, name, seconds, lights=2):
        """So many lights, the last of them after so many seconds."""
        times = [0] * (lights - 1) + [int(seconds * 1e6)]
        (self.at / name).write_bytes(b"lutetia leds 1 4096\n" + b"".join(struct.pack("<Q", time) + b"\1" * 512 for time in times))

    def pictures(self):
        return len(os.listdir(self.at / "pictures")) if (self.at / "pictures").exists() else 0

    def test_a_short_recording_fills_no_disk(self):
        """What a recording only claims makes some thousand pictures, unless more are asked for."""
        leds = ("leds", "--frames", "pictures", "--size", "64x64", "--fps")
        for seconds in (1 << 42, 99999, 3300):  # of a kilobyte
            self.recording_make("endless.leds", seconds)
            said = self.refused(*leds, "1", "endless.leds")
            self.assertIn(b"--fps", said)
            self.assertEqual(b"--pictures %d" % seconds in said, seconds < 1000000, said)
            self.assertLess(self.pictures(), 3)
        self.refused("leds", "--pictures", "9", "endless.leds", status=2)
        self.recording_make("more.leds", 99999, lights=4)
        self.assertIn(b"(3300 are the most)", self.refused(*leds, "1", "more.leds"))
        self.recording_make("minute.leds", 60)
        self.assertIn(b"--pictures 60", self.refused(*leds, "1", "--pictures", "59", "minute.leds"))
        self.run_it(*leds, "1", "--pictures", "60", "minute.leds", status=0)
        self.assertEqual(self.pictures(), 61)

    def test_a_short_song_fills_no_disk(self):
        """A song that claims to take more than an hour is filmed and heard as long as it is said."""
        for wait in (b"\x8f\x50", b"\xff\xff\xff\x7f"):  # 9 hours; longer than numbers of pictures
            track = b"\0\xff\x51\x03\xff\xff\xff\0\x90\x3c\x40" + wait + b"\x80\x3c\x40\0\xff\x2f\0"
            (self.at / "long.mid").write_bytes(b"MThd\0\0\0\6\0\0\0\1\0\x01MTrk" + struct.pack(">I", len(track)) + track)
            for output in (("--frames", "pictures"), ("--video", "k.y4m"), ("--sound", "k.wav")):
                self.assertIn(b"--seconds", self.refused("keys", "long.mid", *output))
                self.assertFalse((self.at / output[1]).exists())
            self.run_it("keys", "long.mid", "--picture", "96x64", "--frames", "pictures", "--fps", "8", "--seconds", "0.5", status=0)
            self.assertEqual(self.pictures(), 5)
            for path in (self.at / "pictures").iterdir():
                path.unlink()
            (self.at / "pictures").rmdir()

    def test_times_of_a_program_are_believed(self):
        """They have passed: there are pictures for all of them."""
        (self.at / "slow").write_bytes(b"#!/bin/sh\ncat endless.leds >$LUTETIA_LEDS\n")
        (self.at / "slow").chmod(0o755)
        self.recording_make("endless.leds", 99999)
        child = subprocess.Popen([LUTETIA, "leds", "--frames", "pictures", "--size", "64x64", "--fps", "1", "./slow"], cwd=self.at,
                                 stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        until = time.monotonic() + SECONDS
        while child.poll() is None and self.pictures() < 5 and time.monotonic() < until:
            time.sleep(0.02)
        child.send_signal(signal.SIGINT)
        said = child.communicate(timeout=SECONDS)[1]
        self.assertEqual((child.returncode, b"--pictures" in said), (130, False), said)
        self.assertGreaterEqual(self.pictures(), 5)

    def test_text_in_a_drawing_is_xml(self):
        self.run_it("type", "a\ufffeb\uffffc", "-o", "n.svg", status=0)
        words = "".join(xml.etree.ElementTree.parse(self.at / "n.svg").getroot().itertext())
        self.assertEqual("".join(words.split()), "abc")

    def test_readers_of_states_hold_nothing_else(self):
        (self.at / "made.lua").write_text("local p = paper{width = 64, height = 64} p:step(1) p:save('a.h5')\n")
        self.run_it("run", "made.lua", "-q", status=0)
        (self.at / "read.lua").write_text("while true do paper.load('a.h5'):close() end\n")
        secret = os.open(self.at / "secret", os.O_RDWR | os.O_CREAT, 0o600)
        child = subprocess.Popen([LUTETIA, "run", "read.lua", "-q", "--timeout", "20"], cwd=self.at, stdin=subprocess.PIPE,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, pass_fds=(secret,))
        seen = []
        while len(seen) < 5 and child.poll() is None:
            for reader in self.children(child.pid):
                held = self.held(reader)
                if held is not None:
                    seen.append(held)
        child.kill()
        child.communicate(timeout=SECONDS)
        os.close(secret)
        if not seen and not os.path.exists("/proc/self/task"):
            self.skipTest("this system does not tell of processes")
        self.assertTrue(seen)
        for held in seen:
            self.assertLessEqual(len(held), 5, held)
            self.assertFalse([name for name in held if name.endswith("secret")], held)

    @staticmethod
    def children(process):
        found = []
        for task in pathlib.Path("/proc/%d/task" % process).glob("*/children"):
            try:
                found += task.read_text().split()
            except OSError:
                pass
        return found

    @staticmethod
    def held(reader):
        """What a confined process has open; None: it is not confined, or has ended meanwhile."""
        try:
            if "Seccomp:\t2" not in pathlib.Path("/proc/%s/status" % reader).read_text():
                return None
            names = [os.readlink(one) for one in pathlib.Path("/proc/%s/fd" % reader).iterdir()]
        except OSError:
            return None
        return names or None

    def test_drawings_have_no_doctype(self):
        count = 60000
        chain = "".join('<!ENTITY e%d "&e%d;">' % (i, i - 1) for i in range(1, count))
        (self.at / "chain.svg").write_text('<!DOCTYPE svg [<!ENTITY e0 "M0 0L1 1">%s]>\n<svg><path d="&e%d;"/></svg>\n' %
                                           (chain, count - 1))
        (self.at / "s.lua").write_text("local p = paper{width = 16, height = 16}\n"
                                       "local b = p:brush{width = 2} b:dip{water = 1} p:stroke{brush = b, svg = 'chain.svg'}\n")
        self.assertIn(b"DOCTYPE", self.refused("run", "s.lua", "-q"))

    def test_ctrl_c_leaves_no_part_of_a_page(self):
        (self.at / "long.txt").write_text(("A marsh and a town. " * 100 + "\n\n") * 2000)
        child = subprocess.Popen([LUTETIA, "set", "long.txt", "--all", "-o", "page.png"], cwd=self.at, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        for _ in range(20 * SECONDS):
            if (self.at / "page-2.png").exists() or child.poll() is not None:
                break
            time.sleep(0.05)
        child.send_signal(signal.SIGINT)
        words = child.communicate(timeout=SECONDS)[0]
        self.assertEqual(child.returncode, 130, words)
        self.assertIn(b"interrupted", words)
        self.assertEqual([name for name in os.listdir(self.at) if name.endswith(".part")], [])

    def test_ctrl_c_leaves_no_part_of_a_sound(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            (self.at / "w.wav").write_text("before")
            child = subprocess.Popen([LUTETIA, "midi", "render", "song.mid", "-t", "5000", "-o", "w.wav"], cwd=self.at,
                                     stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            for _ in range(20 * SECONDS):
                if any(name.endswith(".part") for name in os.listdir(self.at)) or child.poll() is not None:
                    break
                time.sleep(0.05)
            if child.poll() is not None and b"ound" in child.stdout.read():
                self.skipTest("there is no synthesizer")
            child.send_signal(number)
            words = child.communicate(timeout=SECONDS)[0]
            self.assertNotEqual(child.returncode, 0, words)
            self.assertEqual([name for name in os.listdir(self.at) if name.endswith(".part")], [], words)
            self.assertEqual((self.at / "w.wav").read_text(), "before")


if __name__ == "__main__":
    LUTETIA = os.path.abspath(sys.argv.pop(1))
    unittest.main()
