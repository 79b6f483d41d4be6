# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Lifts the objects of simulated scenes by the handles that graspd found, in MuJoCo.

Of each KIND, FOLDER/KIND/solids.jsonl is what graspd-simulate --solids writes, and
FOLDER/KIND/handles.csv what graspd-detect --format csv finds in the same frames, called KIND0,
KIND1, ...
Exit code 1 when a self check fails or too few handles are lifted.
"""
import argparse
import csv
import sys
from dataclasses import dataclass, fields
from pathlib import Path

from model import SceneModel
from scenes import Scene, held_solid, read_scenes
from self_checks import failed_checks
from trial import try_handle


@dataclass(frozen=True)
class Row:
    """One handle. object: the kind of what it holds; stage: where it failed (see trial.Outcome)."""
    scene: str
    rank: int
    object: str
    label: int
    score: float
    width_m: float
    stage: str
    lever_m: float
    mass_kg: float
    lifted: int
    carried: int


def lift_all(scene: Scene) -> list[Row]:
    """Every handle of a scene, each in the scene as it was. Those of what cannot be lifted at all,
    such as the walls of a bin, are left out."""
    model = SceneModel(scene.solids)
    rows = []
    for handle in scene.handles:
        target = held_solid(scene.solids, handle)
        solid = scene.solids[target]
        if not solid.is_object:
            continue
        outcome = try_handle(model, handle, target)
        rows.append(Row(scene.name, handle.rank, solid.kind, solid.label, round(handle.score, 4),
                        round(handle.width_m, 4), outcome.stage, round(outcome.lever_m, 4),
                        round(outcome.mass_kg, 4), int(outcome.lifted), int(outcome.carried)))
    return rows


def lift_kind(folder: Path, kind: str) -> list[Row]:
    return [row for scene in read_scenes(folder, kind) for row in lift_all(scene)]


def first_of_each_object(rows: list[Row]) -> list[Row]:
    firsts: dict[tuple[str, int], Row] = {}
    for row in sorted(rows, key=lambda row: row.rank):
        firsts.setdefault((row.scene, row.label), row)
    return list(firsts.values())


def share(lifted: list[int]) -> str:
    return f"{sum(lifted)} ({100 * sum(lifted) / len(lifted):.1f} %)" if lifted else "0"


def table_line(name: str, rows: list[Row]) -> str:
    firsts = first_of_each_object(rows)
    cells = [name, len(firsts), len(rows), share([row.lifted for row in rows]),
             share([row.carried for row in rows]), share([row.lifted for row in firsts])]
    return f"| {' | '.join(map(str, cells))} |"


def print_table(rows: dict[str, list[Row]]) -> None:
    print("| scenes | objects | handles | lifted | carried | first handle of each object lifted |")
    print("|---|---:|---:|---:|---:|---:|")
    for kind, of_kind in rows.items():
        print(table_line(kind, of_kind))
    if len(rows) > 1:
        print(table_line("total", sum(rows.values(), [])))


def write_csv(path: Path, rows: list[Row]) -> None:
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Row)], lineterminator="\n")
        writer.writeheader()
        writer.writerows(vars(row) for row in rows)


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("kinds", nargs="+", metavar="KIND")
    parser.add_argument("--least", type=float, default=0.85,
                        help="share of handles that must be lifted")
    parser.add_argument("--csv", type=Path, help="write one row a handle into this file")
    return parser.parse_args()


def main() -> int:
    arguments = options()
    failures = failed_checks()
    for failure in failures:
        print(f"lift.py: self check: {failure}", file=sys.stderr)
    if failures:
        return 1
    rows = {kind: lift_kind(arguments.folder / kind, kind) for kind in arguments.kinds}
    handles = sum(rows.values(), [])
    print_table(rows)
    if arguments.csv:
        write_csv(arguments.csv, handles)
    lifted = sum(row.lifted for row in handles)
    if not handles or lifted < arguments.least * len(handles):
        print(f"lift.py: {lifted} of {len(handles)} handles lifted: less than {arguments.least}",
              file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
