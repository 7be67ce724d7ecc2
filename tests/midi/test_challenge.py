"""test_challenge.py LUTETIA: over TCP the token of the MIDI server is shown to be known, and never sent.

A server that does not know the token gets nothing that tells it, and is believed nothing; a client that does not know it learns
nothing and gets no further; what one connection shows is of no use in another, for the other side, or at another port. The codes are
computed here by Python's own hashlib. (security.md 20, 21)
"""
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

import wire

LUTETIA = ""
SECONDS = 30
TOKEN = b"a token of sixteen"
ESCAPES = b"\x1b]0;owned\x07\x1b[31mred"


class FalseServer:
    """Does to each client what `act(connection, frames, port)` does; `heard` is all that clients have sent."""

    def __init__(self, act):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.act, self.heard = act, []
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        while True:
            try:
                connection = self.listener.accept()[0]
            except OSError:
                return
            frames = wire.Frames(connection)
            try:
                self.act(connection, frames, self.port)
            except (OSError, StopIteration):
                pass
            connection.shutdown(socket.SHUT_WR)
            for _ in frames:
                pass
            self.heard.append((frames.all, frames.kinds))
            connection.close()

    def close(self):
        self.listener.close()


class Challenge(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="lutetia-challenge-")
        self.at = pathlib.Path(self.folder.name)
        self.child = None

    def tearDown(self):
        if self.child:
            self.child.terminate()
            self.child.communicate(timeout=SECONDS)
        self.folder.cleanup()

    def run_it(self, port, token=TOKEN, verb="status"):
        return subprocess.run([LUTETIA, "midi", verb, "--server", "127.0.0.1:%d" % port], cwd=self.at, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=SECONDS, check=False, env=dict(os.environ, LUTETIA_MIDI_TOKEN=token.decode()))

    def refused(self, *arguments, words):
        done = self.run_it(*arguments)
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
        self.assertEqual(done.stdout, b"")
        self.assertNotIn(b"\x1b", done.stderr)
        self.assertIn(words, done.stderr)

    def serve(self):
        with socket.create_server(("127.0.0.1", 0)) as listener:
            port = listener.getsockname()[1]
        self.child = subprocess.Popen([LUTETIA, "midi", "serve", "loop", "--server", "./s", "--tcp", str(port), "--usual-priority",
                                       "--may-sleep"], cwd=self.at, env=dict(os.environ, LUTETIA_MIDI_TOKEN=TOKEN.decode()),
                                      stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        for line in self.child.stdout:
            if b"listening" in line:
                break
        return port

    def connect(self, port):
        connection = socket.create_connection(("127.0.0.1", port), timeout=SECONDS)
        self.addCleanup(connection.close)
        return connection, wire.Frames(connection)

    def greeted(self, port, name=b"test"):
        """Says hello; returns the connection, its frames, the hello and the challenge."""
        connection, frames = self.connect(port)
        hello = b"lutetia-midi 2\n" + name + b"\n" + wire.nonce()
        connection.sendall(wire.frame(wire.HELLO, hello))
        kind, challenge, _ = next(frames)
        self.assertEqual(kind, wire.CHALLENGE, challenge)
        self.assertRegex(challenge, b"^[0-9a-f]{64}$")
        return connection, frames, hello, challenge

    def ended(self, frames, words):
        kind, payload, _ = next(frames)
        self.assertEqual(kind, wire.ERROR)
        self.assertIn(words, payload)
        self.assertEqual(list(frames), [])
        self.assertNotIn(TOKEN, frames.all)

    # ---- a server in the place of the owner's ----

    def false_server(self, act, words):
        server = FalseServer(act)
        self.addCleanup(server.close)
        self.refused(server.port, words=words)
        for sent, kinds in server.heard:
            self.assertNotIn(TOKEN, sent)
            self.assertIn(kinds, ([wire.HELLO], [wire.HELLO, wire.PROOF]))
        return server

    def test_a_server_that_asks_nothing_is_refused(self):
        self.false_server(lambda c, frames, port: (next(frames), c.sendall(wire.frame(wire.WELCOME, b"lutetia-midi 2"))), b"knows the token")
        self.false_server(lambda c, frames, port: (next(frames), c.sendall(wire.frame(wire.WELCOME, b"lutetia-midi 1"))), b"knows the token")
        self.false_server(lambda c, frames, port: (next(frames), c.sendall(wire.frame(wire.DEVICE, ESCAPES + b" loop in,out up", device=0))),
                          b"knows the token")
        self.false_server(lambda c, frames, port: (next(frames), c.sendall(wire.frame(wire.ERROR, ESCAPES))), rb"\x1b]0;owned")

    def test_a_server_that_does_not_know_is_refused(self):
        def guess(c, frames, port):
            hello = next(frames)[1]
            c.sendall(wire.frame(wire.CHALLENGE, wire.nonce()))
            proof = next(frames)[1]
            answers = {"other": wire.code(b"guessed", b"server", port, hello, proof), "same": proof, "none": b"", "short": b"0" * 63}
            c.sendall(wire.frame(wire.WELCOME, b"lutetia-midi 2\n" + answers[guess.way]) + wire.frame(wire.DEVICE, b"x loop in,out up", device=0))
        for guess.way in ("other", "same", "none", "short"):
            self.false_server(guess, b"knows the token")

    def test_challenges_of_other_forms_are_refused(self):
        for challenge in (b"", b"0" * 63, b"0" * 65, b"\0" * 64, b"0" * 900):
            self.false_server(lambda c, frames, port, asked=challenge: (next(frames), c.sendall(wire.frame(wire.CHALLENGE, asked))),
                              b"knows the token")

        def twice(c, frames, port):
            next(frames)
            c.sendall(2 * wire.frame(wire.CHALLENGE, b"0" * 64))
        self.false_server(twice, b"knows the token")

    def test_a_server_that_knows_is_believed(self):
        def honest(c, frames, port):
            hello, challenge = next(frames)[1], wire.nonce()
            c.sendall(wire.frame(wire.CHALLENGE, challenge))
            self.assertEqual(next(frames)[1], wire.code(TOKEN, b"client", port, hello, challenge))
            c.sendall(wire.frame(wire.WELCOME, b"lutetia-midi 2\n" + wire.code(TOKEN, b"server", port, hello, challenge)))
            for _, payload, number in frames:
                c.sendall(wire.frame(wire.REPLY, payload + b": " + ESCAPES + b"\n", number=number))
        server = FalseServer(honest)
        self.addCleanup(server.close)
        done = self.run_it(server.port)
        self.assertEqual((done.returncode, done.stdout), (0, rb"status: \x1b]0;owned\x07\x1b[31mred" + b"\n"), done)

    def test_a_relay_at_another_port_is_refused(self):
        true_port = self.serve()

        def relay(c, frames, port):
            other, others = self.connect(true_port)
            for _ in range(2):
                kind, payload, number = next(frames)
                other.sendall(wire.frame(kind, payload, number=number))
                kind, payload, number = next(others)
                c.sendall(wire.frame(kind, payload, number=number))
        self.false_server(relay, b"the token is not right")

    def test_without_a_token_nothing_is_sent(self):
        server = FalseServer(lambda c, frames, port: None)
        self.addCleanup(server.close)
        self.refused(server.port, b"", words=b"LUTETIA_MIDI_TOKEN")
        self.assertEqual([sent for sent, _ in server.heard if sent], [])

    # ---- a client that is not the owner's ----

    def test_who_knows_is_welcome(self):
        port = self.serve()
        connection, frames, hello, challenge = self.greeted(port)
        connection.sendall(wire.frame(wire.PROOF, wire.code(TOKEN, b"client", port, hello, challenge)))
        kind, payload, _ = next(frames)
        self.assertEqual((kind, payload), (wire.WELCOME, b"lutetia-midi 2\n" + wire.code(TOKEN, b"server", port, hello, challenge)))
        self.assertEqual(next(frames)[:2], (wire.DEVICE, b"loop loop in,out up"))
        connection.sendall(wire.frame(wire.COMMAND, b"devices", number=7))
        self.assertEqual(next(frames)[::2], (wire.REPLY, 7))
        self.assertNotIn(TOKEN, frames.all)
        self.assertIn(b"clients: ", self.run_it(port).stdout)

    def test_who_does_not_know_gets_no_further(self):
        port = self.serve()
        codes = [b"", TOKEN, b"0" * 64, b"0" * 63]
        codes += [wire.code(token, side, at, b"", b"") for token in (TOKEN, b"x") for side in (b"client", b"server") for at in (port, 1)]
        for said in codes:
            connection, frames, hello, challenge = self.greeted(port)
            connection.sendall(wire.frame(wire.PROOF, said))
            self.ended(frames, b"the token is not right")
        for wrong in (lambda hello, challenge: wire.code(TOKEN, b"server", port, hello, challenge),
                      lambda hello, challenge: wire.code(TOKEN, b"client", port + 1, hello, challenge),
                      lambda hello, challenge: wire.code(TOKEN[:-1], b"client", port, hello, challenge),
                      lambda hello, challenge: wire.code(TOKEN, b"client", port, hello.replace(b"test", b"best"), challenge)):
            connection, frames, hello, challenge = self.greeted(port)
            connection.sendall(wire.frame(wire.PROOF, wrong(hello, challenge)))
            self.ended(frames, b"the token is not right")

    def test_what_was_shown_once_shows_nothing_again(self):
        port = self.serve()
        connection, frames, hello, challenge = self.greeted(port)
        proof = wire.code(TOKEN, b"client", port, hello, challenge)
        connection.sendall(wire.frame(wire.PROOF, proof))
        self.assertEqual(next(frames)[0], wire.WELCOME)
        other, others = self.connect(port)
        other.sendall(wire.frame(wire.HELLO, hello))
        kind, again, _ = next(others)
        self.assertEqual(kind, wire.CHALLENGE)
        self.assertNotEqual(again, challenge)
        other.sendall(wire.frame(wire.PROOF, proof))
        self.ended(others, b"the token is not right")

    def test_frames_out_of_turn_end_the_connection(self):
        port = self.serve()
        for sent in (wire.frame(wire.COMMAND, b"status"), wire.frame(wire.MIDI, b"\x90\x40\x40", device=0), wire.frame(wire.PROOF, b"0" * 64)):
            connection, frames = self.connect(port)
            connection.sendall(sent)
            self.ended(frames, b"greeting")
            connection, frames, _, _ = self.greeted(port)
            connection.sendall(sent)
            self.assertEqual(next(frames)[0], wire.ERROR)
            self.assertEqual(list(frames), [])
        connection, frames, hello, _ = self.greeted(port)
        connection.sendall(wire.frame(wire.HELLO, hello))
        self.ended(frames, b"a second greeting")
        for hello in (b"", b"lutetia-midi 2", b"lutetia-midi 2\nx", b"lutetia-midi 2\nx\n", b"lutetia-midi 2\nx\n" + b"0" * 63,
                      b"lutetia-midi 3\nx\n" + b"0" * 64):
            connection, frames = self.connect(port)
            connection.sendall(wire.frame(wire.HELLO, hello))
            self.ended(frames, b"the greeting must be: lutetia-midi 2")

    def test_an_old_client_gets_one_line(self):
        port = self.serve()
        for token in (TOKEN, b"", b"guessed"):
            connection, frames = self.connect(port)
            connection.sendall(wire.frame(wire.HELLO, b"lutetia-midi 1\nold\n" + token))
            self.ended(frames, b"this client is too old")

    def test_strangers_write_no_lines(self):
        port = self.serve()
        for _ in range(300):
            connection, frames, _, _ = self.greeted(port, b"\x1b[31m")
            connection.sendall(wire.frame(wire.PROOF, b"0" * 64))
            connection.close()
        self.child.terminate()
        words = self.child.communicate(timeout=SECONDS)[0]
        self.child = None
        self.assertEqual(words, b"")


if __name__ == "__main__":
    LUTETIA = os.path.abspath(sys.argv.pop(1))
    unittest.main()
