# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""A WebSocket client (RFC 6455) of a few lines: a second opinion on what our servers speak."""
import base64
import hashlib
import os
import socket
import struct
from urllib.parse import urlsplit

from harness import PATIENCE_S

GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Closed(Exception):
    """The server closed the connection, or did not open it."""


class WebSocket:
    def __init__(self, url, patience_s=PATIENCE_S):
        parts = urlsplit(url)
        self._socket = socket.create_connection((parts.hostname, parts.port), patience_s)
        key = base64.b64encode(os.urandom(16)).decode()
        target = parts.path + (f"?{parts.query}" if parts.query else "")
        self._socket.sendall((f"GET {target} HTTP/1.1\r\nHost: {parts.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        self._input = self._socket.makefile("rb")
        status = self._input.readline().decode()
        headers = {}
        while True:
            line = self._input.readline().decode().strip()
            if not line:
                break
            name, value = line.split(":", 1)
            headers[name.lower()] = value.strip()
        expected = base64.b64encode(hashlib.sha1((key + GUID).encode()).digest()).decode()
        if " 101 " not in status or headers.get("sec-websocket-accept") != expected:
            self.close()
            raise Closed(status.strip())

    def close(self):
        self._socket.close()

    def send(self, data):
        """Text as a text message, bytes as a binary one."""
        kind, data = (TEXT, data.encode()) if isinstance(data, str) else (BINARY, data)
        self._send_frame(kind, data)

    def _send_frame(self, kind, data):
        size = len(data)
        header = bytes([0x80 | kind])
        if size < 126:
            header += bytes([0x80 | size])
        else:
            header += bytes([0x80 | 126]) + struct.pack(">H", size) if size < 65536 else bytes([0x80 | 127]) + struct.pack(">Q", size)
        # The mask 0 leaves the bytes as they are.
        self._socket.sendall(header + bytes(4) + data)

    def _read(self, count):
        data = self._input.read(count)
        if len(data) < count:
            raise Closed("the connection ended")
        return data

    def receive(self):
        """The next message, str or bytes."""
        kind, message = None, b""
        while True:
            first, second = self._read(2)
            size = second & 127
            if size >= 126:
                size, = struct.unpack(">H" if size == 126 else ">Q", self._read(2 if size == 126 else 8))
            data = self._read(size)
            code = first & 15
            if code == CLOSE:
                raise Closed(data[2:].decode(errors="replace"))
            if code == PING:
                self._send_frame(PONG, data)
            elif code != PONG:
                kind = code or kind
                message += data
                if first & 0x80:
                    return message.decode() if kind == TEXT else message
