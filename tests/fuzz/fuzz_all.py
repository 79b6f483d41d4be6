#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every fuzzer for a while, one after the other, and prints a table of executions, coverage and findings.

    cmake --preset fuzz && cmake --build --preset fuzz
    tests/fuzz/fuzz_all.py --seconds 150          exit 0: no findings; 1: findings, kept in the work folder

What a fuzzer learns stays in the work folder for the next run; --merge puts what covers more into tests/fuzz/corpus.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
# Bytes of the largest input, where libFuzzer's own choice is too small for all of a file, or large ones are slow.
MAX_BYTES = {"detect": 3400, "service_config": 1024, "sensor_config": 1024, "gripper_config": 1024, "pcd": 4096, "ply": 4096,
             "event_log": 4096, "parquet": 4096}
DICTIONARIES = {"service_config": "config", "gripper_config": "config", "sensor_config": "config", "pcd": "pcd",
                "ply": "ply", "event_log": "event_log"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[1] / "build-fuzz/bin")
    parser.add_argument("--work", type=pathlib.Path, default=HERE.parents[1] / "build-fuzz/fuzz")
    parser.add_argument("--seconds", type=int, default=60, help="for each fuzzer (default: %(default)s)")
    parser.add_argument("--only", nargs="+", help="names of fuzzers; default: all")
    parser.add_argument("--timeout", type=int, default=20, help="one input may take so long [s] (default: %(default)s)")
    parser.add_argument("--memory", type=int, default=2048, help="all of it [MB] (default: %(default)s)")
    parser.add_argument("--allocation", type=int, default=512, help="a single one [MB] (default: %(default)s)")
    parser.add_argument("--merge", action="store_true", help="add what covers more to tests/fuzz/corpus")
    parser.add_argument("--max-merged-bytes", type=int, default=2048, help="of a file that --merge adds")
    return parser.parse_args()


def names(options):
    """The fuzzers that are built, in alphabetical order."""
    found = sorted(p.name.removeprefix("graspd_fuzz_") for p in options.bin.glob("graspd_fuzz_*"))
    if not found:
        sys.exit(f"no fuzzers in {options.bin}: cmake --preset fuzz && cmake --build --preset fuzz")
    return [n for n in found if options.only is None or n in options.only]


def environment():
    """Memory that is handed back at once, so that the limit is on what is held."""
    return {**os.environ, "ASAN_OPTIONS": "allocator_may_return_null=0:quarantine_size_mb=16:detect_leaks=1",
            "UBSAN_OPTIONS": "print_stacktrace=1"}


def last_number(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def run(options, name):
    """Fuzzes one target; returns (executions, coverage, files in the corpus, finding files, seconds)."""
    learned = options.work / "corpus" / name
    findings = options.work / "findings" / f"{name}-{time.time_ns()}"
    for folder in (learned, findings):
        folder.mkdir(parents=True, exist_ok=True)
    start, executions, coverage, corpus = time.monotonic(), 0, 0, 0
    # libFuzzer ends at a finding: carry on for what is left of the time.
    while (left := options.seconds - (time.monotonic() - start)) >= 1:
        command = [str(options.bin / f"graspd_fuzz_{name}"), str(learned), str(HERE / "corpus" / name),
                   f"-max_total_time={int(left)}", f"-timeout={options.timeout}", f"-rss_limit_mb={options.memory}",
                   f"-malloc_limit_mb={options.allocation}", f"-artifact_prefix={findings}/",
                   "-print_final_stats=1", "-verbosity=1"]
        if name in MAX_BYTES:
            command.append(f"-max_len={MAX_BYTES[name]}")
        dictionary = HERE / "dictionaries" / f"{DICTIONARIES.get(name)}.dict"
        if dictionary.exists():
            command.append(f"-dict={dictionary}")
        log = options.work / f"{name}.log"
        with open(log, "wb") as out:
            code = subprocess.run(command, stdout=out, stderr=out, env=environment(), check=False).returncode
        text = log.read_text(encoding="utf-8", errors="replace")
        executions += last_number(r"stat::number_of_executed_units: *(\d+)", text)
        coverage = max(coverage, last_number(r"cov: (\d+)", text))
        corpus = last_number(r"corp: (\d+)", text)
        if code == 0:
            break
        log.rename(options.work / f"{name}-{int(time.time())}.finding.log")
        if not any(findings.iterdir()):
            sys.exit(f"{name} ended with {code} and no finding:\n{text[-2000:]}")
    return executions, coverage, corpus, sorted(findings.iterdir()), time.monotonic() - start


def merge(options, name):
    """Adds small learned files that cover what the committed ones do not."""
    small = options.work / "small" / name
    small.mkdir(parents=True, exist_ok=True)
    for path in small.iterdir():
        path.unlink()
    for path in (options.work / "corpus" / name).iterdir():
        if path.stat().st_size <= options.max_merged_bytes:
            os.link(path, small / path.name)
    subprocess.run([str(options.bin / f"graspd_fuzz_{name}"), "-merge=1", str(HERE / "corpus" / name), str(small)],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment(), check=True)


def main():
    options = parse_arguments()
    print("| target | executions | a second | coverage [edges] | corpus | findings |", flush=True)
    print("|---|---:|---:|---:|---:|---:|", flush=True)
    total, findings = 0, []
    for name in names(options):
        executions, coverage, corpus, found, seconds = run(options, name)
        total += executions
        findings += found
        print(f"| {name} | {executions:,} | {executions / max(seconds, 1e-9):,.0f} | {coverage:,} | {corpus:,} | "
              f"{len(found)} |", flush=True)
        if options.merge:
            merge(options, name)
    print(f"| all | {total:,} | | | | {len(findings)} |", flush=True)
    for path in findings:
        print(f"finding: {path}", file=sys.stderr)
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
