# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""A tcpq server like lcm-tcpq-server, in this process: can be stopped and started again, and keeps what was published."""
import re
import socket
import struct
import threading

HELLO = struct.pack(">II", 0x287617FA, 0x0100)
CLIENTS_HELLO = struct.pack(">II", 0x287617FB, 0x0100)
PUBLISH, SUBSCRIBE, UNSUBSCRIBE = 1, 2, 3


class TcpqServer:
    """Serves until stop(); start() again on the same port. While silent it takes connections and says nothing."""

    def __init__(self):
        self.silent = False
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.messages = []  # (channel, bytes)
        self._lock = threading.Lock()
        self._clients = {}  # socket -> channel expressions
        self._listener = None

    @property
    def url(self):
        return f"tcpq://127.0.0.1:{self.port}"

    def start(self):
        self._listener = socket.socket()
        self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self._listener.bind(("127.0.0.1", self.port))
        self._listener.listen()
        threading.Thread(target=self._accept, args=(self._listener,), daemon=True).start()

    def stop(self):
        """Hangs up on everybody, and takes nobody any more."""
        self._close([self._listener])
        self.hang_up()

    def hang_up(self):
        with self._lock:
            clients = list(self._clients)
            self._clients.clear()
        self._close(clients)

    @staticmethod
    def _close(sockets):
        for one in sockets:
            try:
                one.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
            one.close()

    def on(self, channel, wire_type):
        with self._lock:
            return [wire_type.decode(data) for name, data in self.messages if name == channel]

    def publish(self, channel, data):
        """As if a client had."""
        name = channel.encode()
        packet = struct.pack(">II", PUBLISH, len(name)) + name + struct.pack(">I", len(data)) + data
        with self._lock:
            self.messages.append((channel, data))
            wanting = [c for c, wanted in self._clients.items() if any(re.fullmatch(w, channel) for w in wanted)]
        for client in wanting:
            try:
                client.sendall(packet)
            except OSError:
                pass

    def _accept(self, listener):
        while True:
            try:
                client, _ = listener.accept()
            except OSError:
                return
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client):
        try:
            if self.silent:
                self._take(client, 1 << 30)
            client.sendall(HELLO)
            if self._take(client, 8) != CLIENTS_HELLO:
                return
            with self._lock:
                self._clients[client] = []
            while True:
                kind, length = struct.unpack(">II", self._take(client, 8))
                name = self._take(client, length).decode()
                if kind == PUBLISH:
                    self.publish(name, self._take(client, struct.unpack(">I", self._take(client, 4))[0]))
                    continue
                with self._lock:
                    wanted = self._clients[client]
                    wanted.append(name) if kind == SUBSCRIBE else wanted.remove(name)
        except (OSError, EOFError, KeyError):
            pass
        finally:
            with self._lock:
                self._clients.pop(client, None)
            client.close()

    @staticmethod
    def _take(client, count):
        data = b""
        while len(data) < count:
            part = client.recv(count - len(data))
            if not part:
                raise EOFError
            data += part
        return data
