# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""What ./run demo says at its end: how many frames were answered, how fast, and how many objects got a handle.

    python3 demo_summary.py HANDLES TRUTH

HANDLES is what graspd-listen writes as JSON lines, TRUTH what graspd-simulate writes of the objects it shows.
"""
import json
import math
import sys

# An object of fewer pixels is hardly seen; the demo does not ask for a handle on it.
SMALLEST_OBJECT_SHARE = 0.001
# A handle belongs to the object of the nearest point of any, within this distance [m].
REACH_M = 0.02


def read_lines(path):
    """The objects of a file of JSON lines; a last line that is not complete does not count."""
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.endswith("\n")]


def percentile(values, share):
    """The value that this share of the values does not exceed (nearest rank)."""
    ordered = sorted(values)
    return ordered[max(0, math.ceil(share * len(ordered)) - 1)]


def object_of(position, objects):
    """The label of the object that a handle is on, None for none."""
    best = (REACH_M, None)
    for one in objects:
        for point in one["points"]:
            distance = math.dist(position, point)
            if distance < best[0]:
                best = (distance, one["label"])
    return best[1]


def count_objects(answers, truth):
    """(objects shown, objects with a handle, handles on an object) over the frames that were worked on."""
    shown = held = on_an_object = 0
    for answer in answers:
        frame = truth.get(answer["seq"])
        if frame is None or answer["status"] not in ("OK", "NO_HANDLES"):
            continue
        smallest = SMALLEST_OBJECT_SHARE * answer["points_in"]
        visible = {one["label"] for one in frame["objects"] if one["pixels"] >= smallest}
        labels = [object_of(handle["position"], frame["objects"]) for handle in answer["handles"]]
        shown += len(visible)
        held += len(visible & set(labels))
        on_an_object += sum(label is not None for label in labels)
    return shown, held, on_an_object


def summary(answers, truth):
    """The lines of the summary: (what, value)."""
    worked_on = [a for a in answers if a["status"] in ("OK", "NO_HANDLES")]
    dropped = [a for a in answers if a["status"] == "OVERLOADED"]
    rows = [("frames sent", len(truth)), ("answered", len(answers)), ("of these dropped for newer ones", len(dropped))]
    if worked_on:
        latencies = [1e3 * a["latency"] for a in worked_on]
        handles = sum(len(a["handles"]) for a in worked_on)
        shown, held, on_an_object = count_objects(answers, truth)
        rows += [("latency, cloud to handles", f"p50 {percentile(latencies, 0.5):.1f} ms, "
                                               f"p99 {percentile(latencies, 0.99):.1f} ms"),
                 ("handles per frame", f"{handles / len(worked_on):.1f}"),
                 ("handles on an object", f"{on_an_object} of {handles}"),
                 ("objects with a handle", f"{held} of {shown}" + (f" ({100 * held / shown:.0f} %)" if shown else ""))]
    return rows


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    answers = read_lines(arguments[0])
    truth = {frame["seq"]: frame for frame in read_lines(arguments[1])}
    rows = summary(answers, truth)
    width = max(len(what) for what, _ in rows)
    for what, value in rows:
        print(f"  {what:<{width}}  {value}")
    return 0 if answers and len(answers) == len(truth) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
