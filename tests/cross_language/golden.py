# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""golden.py GOLDEN_FOLDER OUT_FOLDER: decodes every golden message by the Python package, writes its values as JSON and encodes
it again."""
import json
import pathlib
import sys

import graspd


def plain(value):
    if hasattr(value, "__slots__"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    return [plain(v) for v in value] if isinstance(value, (list, tuple, bytes)) else value


for path in pathlib.Path(sys.argv[1]).glob("*_t.bin"):
    message = getattr(graspd, path.stem).decode(path.read_bytes())
    pathlib.Path(sys.argv[2], f"{path.stem}.json").write_text(json.dumps(plain(message)), encoding="utf-8")
    pathlib.Path(sys.argv[2], path.name).write_bytes(message.encode())
