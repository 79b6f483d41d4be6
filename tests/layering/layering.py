# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the sources to the project's rules: who may include whom, licence lines, length of files and functions.

    python3 layering.py REPOSITORY      exit 0: all kept; 1: one line for each violation
"""
import ast
import pathlib
import re
import sys

from cpp_functions import long_blocks

MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60
SPDX = ("SPDX-FileCopyrightText: ", "SPDX-License-Identifier: BSD-3-Clause")

CPP = {".cpp", ".hpp", ".c", ".h"}
SOURCES = CPP | {".py", ".sh", ".cmake", ".js", ".ts"}
LICENSED = SOURCES | {".yaml", ".yml", ".service"}
LICENSED_NAMES = {"CMakeLists.txt", "Dockerfile", "run"}
SKIPPED = re.compile(r"(\.git|build|build-.*|__pycache__|\.cache|node_modules|dist)")

# Own folders that a layer may include, besides itself. A file in place of a folder narrows the permission to it.
OWN = {
    "lcmtypes": set(),
    "service/pipeline": set(),
    "service/runtime": set(),
    # Values only: what a frame is and what a detection says, never a stage.
    "service/transport": {
        "lcmtypes",
        "service/pipeline/config_fields.hpp",
        "service/pipeline/detect_handles.hpp",
        "service/pipeline/gripper.hpp",
        "service/pipeline/handle.hpp",
        "service/pipeline/handle_check.hpp",
        "service/pipeline/point_cloud.hpp",
    },
    # The decoders' limits and what they cannot read from a message are settings like the pipeline's.
    "service/config": {"service/pipeline", "service/transport/cloud_input.hpp", "service/transport/refusal.hpp"},
    "service/daemon": {"lcmtypes", "service/config", "service/transport", "service/runtime", "service/pipeline"},
    # graspd-detect reads the daemon's configuration, so that both find the same handles.
    # graspd-replay answers a frame by the daemon's own code; it and graspd-bench keep memory as the daemon does.
    "client": {"lcmtypes", "service/transport", "service/pipeline", "service/config",
               "service/daemon/answer.hpp", "service/daemon/frame_processor.hpp", "service/runtime/clock.hpp",
               "service/runtime/kept_memory.hpp"},
    "tests": {"lcmtypes", "service/config", "service/transport", "service/runtime", "service/pipeline",
              "service/daemon", "client"},
}

# Foreign headers by library, and the layers that may use it.
LIBRARIES = [
    ("LCM", re.compile(r"lcm/"), {"service/transport", "client", "tests"}),
    ("libsodium", re.compile(r"sodium"), {"service/transport", "client"}),
    ("zlib, libspng", re.compile(r"(zlib|spng)\.h"), {"service/transport", "tests"}),
    ("zstd", re.compile(r"zstd\.h"), {"client"}),
    ("yaml-cpp", re.compile(r"yaml-cpp/"), {"service/config", "tests"}),
    ("spdlog", re.compile(r"(spdlog|fmt)/"), {"service/runtime", "service/daemon", "client"}),
    ("CLI11", re.compile(r"CLI/"), {"service/daemon", "client", "tests"}),
    ("PCL", re.compile(r"pcl/"), {"service/pipeline", "client", "tests"}),
    ("Eigen", re.compile(r"Eigen/"), {"service/pipeline", "service/transport", "service/config", "service/daemon",
                                      "client", "tests"}),
    ("Boost", re.compile(r"boost/"), {"client", "tests"}),
    ("oneTBB", re.compile(r"(tbb|oneapi)/"), {"service/pipeline", "service/runtime", "service/daemon", "client",
                                              "tests"}),
    ("test library", re.compile(r"(gtest|gmock|benchmark)/"), {"tests"}),
]
# The method is pure: no files, clock, threads of its own or output.
IMPURE = re.compile(r"(chrono|ctime|time\.h|filesystem|fstream|iostream|cstdio|stdio\.h|thread)")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    """The layer that a path of the repository belongs to; None outside of all."""
    parts = path.split("/")
    if parts[0] == "service" and len(parts) > 2:
        return "/".join(parts[:2])
    return parts[0] if parts[0] in OWN and len(parts) > 1 else None


def own_target(root, including, header):
    """The repository path that an include names, or None when it is somebody else's header."""
    if header.startswith("lcmtypes/") or header.startswith("graspd/") or header.startswith("graspd_"):
        return "lcmtypes/" + header.split("/")[-1]  # generated at build time
    for candidate in (root / header, including.parent / header):
        if candidate.is_file():
            return candidate.resolve().relative_to(root.resolve()).as_posix()
    if header.split("/")[0] in ("service", "client", "tests"):
        return header
    return None


def own_include_problem(layer, target):
    to = layer_of(target)
    if to == layer or target in OWN[layer] or to in OWN[layer]:
        return None
    return f"{layer} must not include {to or 'a file at the root'}: {target}"


def foreign_include_problem(layer, is_header, header):
    for name, pattern, layers in LIBRARIES:
        if pattern.match(header):
            if layer not in layers:
                return f"{layer} must not use {name}: {header}"
            if name == "PCL" and is_header:
                return f"PCL belongs into .cpp files, its headers take seconds to parse: {header}"
    if layer == "service/pipeline" and IMPURE.fullmatch(header):
        return f"{layer} is pure, it has no use for <{header}>"
    return None


def include_problems(root, path, name, lines):
    layer = layer_of(name)
    if layer is None:
        return
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        header = match.group(2)
        target = own_target(root, path, header)
        if target is not None:
            problem = own_include_problem(layer, target)
            if match.group(1) == '"' and header.startswith("."):
                problem = problem or f"the include root is the repository: {header}"
        else:
            problem = foreign_include_problem(layer, path.suffix in {".hpp", ".h"}, header)
        if problem:
            yield f"{name}:{number}: {problem}"


def function_problems(path, name, text):
    if path.suffix in CPP:
        blocks = long_blocks(text, MAX_FUNCTION_LINES)
    elif path.suffix == ".py":
        functions = (n for n in ast.walk(ast.parse(text)) if isinstance(n, (ast.FunctionDef, ast.AsyncFunctionDef)))
        blocks = [(f.lineno, f.end_lineno - f.lineno + 1) for f in functions]
        blocks = [b for b in blocks if b[1] > MAX_FUNCTION_LINES]
    else:
        blocks = []
    for line, length in blocks:
        yield f"{name}:{line}: a function of {length} lines (at most {MAX_FUNCTION_LINES})"


def file_problems(root, path):
    name = path.relative_to(root).as_posix()
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    if path.suffix in LICENSED or path.name in LICENSED_NAMES:
        head = "\n".join(lines[:4])
        for line in SPDX:
            if line not in head:
                yield f"{name}:1: no line '{line.strip()}' at the top"
    if (path.suffix in SOURCES or path.name == "run") and len(lines) > MAX_FILE_LINES:
        yield f"{name}:1: {len(lines)} lines (at most {MAX_FILE_LINES})"
    if path.suffix in CPP:
        yield from include_problems(root, path, name, lines)
    yield from function_problems(path, name, text)


def own_files(folder):
    for path in sorted(folder.iterdir()):
        if SKIPPED.fullmatch(path.name):
            continue
        if path.is_dir():
            yield from own_files(path)
        elif path.suffix in LICENSED or path.name in LICENSED_NAMES:
            yield path


def problems(root):
    """(number of files looked at, every violation in the repository as a line)."""
    files = list(own_files(root))
    return len(files), [problem for path in files for problem in file_problems(root, path)]


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    count, found = problems(pathlib.Path(arguments[0]).resolve())
    for problem in found:
        print(problem)
    print(f"{count} files, {len(found)} violations")
    return 1 if found or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
