"""The protocol of docs/midi.md in Python, for tests that stand in for a server or a client."""
import hashlib
import hmac
import os
import struct

HELLO, COMMAND, MIDI, PROOF, WELCOME, DEVICE, LOST, REPLY, ERROR, CHALLENGE = 1, 2, 3, 4, 16, 17, 18, 19, 20, 21


def frame(kind, payload=b"", device=255, number=0):
    return struct.pack("<HBBIQ", len(payload), kind, device, number, 0) + payload


def nonce():
    return os.urandom(32).hex().encode()


def code(token, side, port, hello, challenge):
    """What who knows the token answers."""
    said = hashlib.sha256(b"%d\n" % port + hello + b"\n" + challenge).digest()
    return hmac.new(token, side + b"\n" + said, hashlib.sha256).hexdigest().encode()


class Frames:
    """The frames that come from a socket: (kind, payload, number); `all` and `kinds` are what has come. Ends with the connection."""

    def __init__(self, connection):
        self.connection, self.rest, self.all, self.kinds = connection, b"", b"", []

    def __iter__(self):
        return self

    def __next__(self):
        while len(self.rest) < 16 or len(self.rest) < 16 + struct.unpack("<H", self.rest[:2])[0]:
            try:
                more = self.connection.recv(65536)
            except OSError:
                more = b""
            if not more:
                raise StopIteration
            self.rest += more
            self.all += more
        count, kind, _, number, _ = struct.unpack("<HBBIQ", self.rest[:16])
        payload, self.rest = self.rest[16:16 + count], self.rest[16 + count:]
        self.kinds.append(kind)
        return kind, payload, number
