# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads and writes LCM types straight from their .lcm files: a second opinion on what the programs put on the wire."""
import pathlib
import re
import struct
import types

LCMTYPES = pathlib.Path(__file__).resolve().parents[2] / "lcmtypes"
PRIMITIVES = {"int8_t": "b", "int16_t": "h", "int32_t": "i", "int64_t": "q", "float": "f", "double": "d",
              "boolean": "b", "byte": "B"}
MASK = (1 << 64) - 1


def _hash_update(value, c):
    signed = value - (1 << 64) if value >> 63 else value
    return (((value << 8) ^ (signed >> 55)) + c) & MASK


def _hash_string(value, text):
    value = _hash_update(value, len(text))
    for c in text:
        value = _hash_update(value, ord(c))
    return value


def _elements(value, dimensions):
    """The single values of an array, in their order."""
    if dimensions == 0:
        yield value
    else:
        for part in value:
            yield from _elements(part, dimensions - 1)


class Type:
    """One struct: members as (type, name, dimensions), constants as a dictionary. Decodes one dimension, encodes any."""

    def __init__(self, text, registry):
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)
        self.name = re.search(r"\bstruct\s+(\w+)", text).group(1)
        self.registry, self.members, self.constants = registry, [], {}
        body = text[text.index("{") + 1:text.rindex("}")]
        for statement in filter(None, (s.strip() for s in body.split(";"))):
            constant = re.match(r"const\s+\w+\s+(.*)", statement, re.DOTALL)
            if constant:
                for part in constant.group(1).split(","):
                    key, value = part.split("=")
                    self.constants[key.strip()] = int(value, 0)
                continue
            kind, names = statement.split(None, 1)
            kind = kind.split(".")[-1]  # a struct of another package
            for name in names.split(","):
                dimensions = re.findall(r"\[\s*(\w+)\s*\]", name)
                self.members.append((kind, name.split("[")[0].strip(), dimensions))

    def _hash(self):
        value = 0x12345678
        for kind, name, dimensions in self.members:
            value = _hash_string(value, name)
            if kind in PRIMITIVES or kind == "string":
                value = _hash_string(value, kind)
            value = _hash_update(value, len(dimensions))
            for size in dimensions:
                value = _hash_update(value, 0 if size.isdigit() else 1)
                value = _hash_string(value, size)
        for kind, _, _ in self.members:
            if kind in self.registry:
                value = (value + self.registry[kind]._hash()) & MASK
        return ((value << 1) & MASK) + (value >> 63)

    @property
    def fingerprint(self):
        return struct.pack(">Q", self._hash())

    def encode(self, **values):
        return self.fingerprint + self._encode(types.SimpleNamespace(**values))

    def decode(self, data):
        if data[:8] != self.fingerprint:
            raise ValueError(f"not a {self.name}")
        message, end = self._decode(memoryview(data), 8)
        if end != len(data):
            raise ValueError(f"{len(data) - end} bytes after the end of a {self.name}")
        return message

    def _encode(self, message):
        out = []
        for kind, name, dimensions in self.members:
            value = getattr(message, name)
            if kind in ("byte",) and dimensions:
                out.append(bytes(value))
            else:
                out.extend(self._encode_one(kind, v) for v in _elements(value, len(dimensions)))
        return b"".join(out)

    def _encode_one(self, kind, value):
        if kind in PRIMITIVES:
            return struct.pack(">" + PRIMITIVES[kind], value)
        if kind == "string":
            text = value.encode()
            return struct.pack(">i", len(text) + 1) + text + b"\0"
        return self.registry[kind]._encode(value)

    def _decode(self, data, at):
        message = types.SimpleNamespace()
        for kind, name, dimensions in self.members:
            if not dimensions:
                value, at = self._decode_one(kind, data, at)
            else:
                size = dimensions[0]
                count = int(size) if size.isdigit() else getattr(message, size)
                value, at = self._decode_array(kind, data, at, count)
            setattr(message, name, value)
        return message, at

    def _decode_array(self, kind, data, at, count):
        if kind == "byte":
            return bytes(data[at:at + count]), at + count
        values = []
        for _ in range(count):
            value, at = self._decode_one(kind, data, at)
            values.append(value)
        return values, at

    def _decode_one(self, kind, data, at):
        if kind in PRIMITIVES:
            code = ">" + PRIMITIVES[kind]
            return struct.unpack_from(code, data, at)[0], at + struct.calcsize(code)
        if kind == "string":
            length = struct.unpack_from(">i", data, at)[0]
            return bytes(data[at + 4:at + 3 + length]).decode(), at + 4 + length
        return self.registry[kind]._decode(data, at)


def load_types(folder=LCMTYPES):
    """Every type of a folder by its name."""
    registry = {}
    for path in sorted(pathlib.Path(folder).glob("*.lcm")):
        one = Type(path.read_text(encoding="utf-8"), registry)
        registry[one.name] = one
    return registry
