"""A client of `vigil serve` for tests: a WebSocket and HTTP with nothing but the standard library."""

import base64
import http.client
import json
import os
import re
import select
import socket
import struct
import subprocess
import time

PATIENCE_S = 30  # for a busy machine; what is waited for comes at once on an idle one


class WebSocket:
    """A connection to /live. `head` is the server's answer to the upgrade."""

    def __init__(self, port, headers=(), protocol="vigil.v1", host=None, path="/live", receive_buffer=None, tls=None):
        self.sock = socket.socket()
        if receive_buffer:
            self.sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.sock.settimeout(PATIENCE_S)
        self.sock.connect(("127.0.0.1", port))
        if tls:
            self.sock = tls.wrap_socket(self.sock, server_hostname="127.0.0.1")
        lines = [
            f"GET {path} HTTP/1.1",
            f"Host: {host or f'127.0.0.1:{port}'}",
            "Upgrade: websocket",
            "Connection: Upgrade",
            f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}",
            "Sec-WebSocket-Version: 13",
            *([f"Sec-WebSocket-Protocol: {protocol}"] if protocol else []),
            *headers,
        ]
        self.sock.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        self.buffer = b""
        while b"\r\n\r\n" not in self.buffer:
            self.buffer += self._more()
        head, self.buffer = self.buffer.split(b"\r\n\r\n", 1)
        self.status = int(head.split()[1])

    def _more(self):
        data = self.sock.recv(1 << 16)
        if not data:
            raise EOFError
        return data

    def _take(self, size):
        while len(self.buffer) < size:
            self.buffer += self._more()
        data, self.buffer = self.buffer[:size], self.buffer[size:]
        return data

    def receive(self):
        """(opcode, payload) of the next frame."""
        first, second = self._take(2)
        size = second & 127
        if size == 126:
            (size,) = struct.unpack(">H", self._take(2))
        elif size == 127:
            (size,) = struct.unpack(">Q", self._take(8))
        return first & 15, self._take(size)

    def send(self, payload, opcode=1):
        data = payload if isinstance(payload, bytes) else json.dumps(payload).encode()
        size = len(data)
        if size < 126:
            head = bytes([0x80 | opcode, 0x80 | size])
        elif size < 1 << 16:
            head = bytes([0x80 | opcode, 0xFE]) + struct.pack(">H", size)
        else:
            head = bytes([0x80 | opcode, 0xFF]) + struct.pack(">Q", size)
        self.sock.sendall(head + b"\0\0\0\0" + data)  # a mask of zeros is a mask

    def wait_for(self, wanted):
        """The next message for which wanted(message) is true; binary ones are {"type": "frame", ...}."""
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            opcode, payload = self.receive()
            if opcode == 8:
                raise EOFError
            if opcode == 9:
                self.send(payload, 10)
            message = json.loads(payload) if opcode == 1 else {"type": "frame", "bytes": payload}
            if opcode in (1, 2) and wanted(message):
                return message
        raise TimeoutError("it did not come")

    def wait_for_type(self, kind):
        return self.wait_for(lambda message: message["type"] == kind)

    def wait_for_event(self, what, drone=None):
        def is_it(event):
            return event["what"] == what and drone in (None, event["drone"])

        message = self.wait_for(lambda m: m["type"] == "events" and any(map(is_it, m["events"])))
        return next(filter(is_it, message["events"]))

    def snapshot(self):
        return read_snapshot(self.wait_for(lambda m: m["type"] == "frame" and m["bytes"][4] == 1)["bytes"])

    def hello(self, **members):
        self.send({"type": "hello", **members})
        return self.wait_for_type("hello")

    def ask(self, **command):
        """Sends a command; its answer."""
        self.send(command)
        return self.wait_for(lambda m: m["type"] in ("ack", "refused", "pong", "why") and m["id"] == command["id"])

    def is_closed(self):
        """Whether the server ends the connection."""
        try:
            while self.receive()[0] != 8:
                pass
        except (EOFError, ConnectionError):
            pass
        return True

    def close(self):
        self.sock.close()

    __del__ = close


def read_snapshot(frame):
    magic, kind, flags, header, epoch, drones = struct.unpack_from("<4sBBHII", frame)
    assert magic == b"VGL1" and kind == 1 and header >= 96
    tick, time_s, wall_ms = struct.unpack_from("<ddd", frame, 16)
    held_rows = struct.unpack_from("<I", frame, 88)[0]
    positions = struct.unpack_from(f"<{2 * drones}f", frame, header)
    return {
        "flags": flags, "epoch": epoch, "drones": drones, "tick": tick, "time_s": time_s, "wall_ms": wall_ms,
        "held_rows": held_rows, "positions": positions, "bytes": len(frame),
    }  # fmt: skip


class Program:
    """A running `vigil serve`, or another command with a console, on a free port of this machine."""

    def __init__(self, vigil, subject, *arguments, command="serve"):
        words = [vigil, command, str(subject), "--port", "0", *map(str, arguments)]
        self.process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        found = re.search(r":(\d+)/", line)
        if not found:
            raise RuntimeError(f"{line}{self.process.communicate()[1]}")
        self.port = int(found[1])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.communicate(timeout=PATIENCE_S)

    def kill(self):
        self.process.kill()
        self.process.wait()

    def request(self, method, path, body=None, **headers):
        """(status, headers, bytes) of an HTTP answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        data = body if isinstance(body, (bytes, type(None))) else json.dumps(body).encode()
        names = {name.replace("_", "-"): value for name, value in headers.items()}
        connection.request(method, path, data, names)
        answer = connection.getresponse()
        result = answer.status, dict(answer.getheaders()), answer.read()
        connection.close()
        return result

    def json(self, method, path, body=None, **headers):
        if body is not None:
            headers.setdefault("Content_Type", "application/json")
        status, _, data = self.request(method, path, body, **headers)
        return status, json.loads(data)

    def memory_kib(self):
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as status:
            return int(re.search(r"VmRSS:\s+(\d+)", status.read())[1])


def is_readable(sock, seconds):
    return bool(select.select([sock], [], [], seconds)[0])
