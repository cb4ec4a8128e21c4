"""Tiles against one piece: python suite.py --points 2000000 [--only PART ...] [--write] [--keep FOLDER]

Compares the answers of `visible_from_tiles` on a Dask cluster with those of one cloud, ends workers and commands in
the middle, and measures memory and the shares of tiles that are skipped. Ends with status 1 if anything differs.
`--write` puts each part into its section of RESULTS.md. With `--keep` the tiles and the finished answers of a comparison
stay in a folder, and the same command goes on from there.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import sys
import tempfile
import time
from contextlib import contextmanager, nullcontext
from pathlib import Path

import numpy as np

from city import UTM, VIEWPOINTS, city, cut, write
from killed import Killer, command, kill_when_kept
from pieces import QUESTIONS, WORKERS, ask_whole, cluster, compare, differences, peaks, share

from hidden_point_removal.distributed import plan, sectors, visible_from_tiles

HERE = Path(__file__).parent

#: The ways to cut the city into tiles: title, files, precision, place.
CASES = {
    "spatial": ("Squares of the ground, LAZ, map coordinates", "LAZ", np.float64, UTM),
    "random": ("Random cut, NumPy files, float32", "NumPy", np.float32, np.zeros(3)),
}
PARTS = [*CASES, "sectors", "workers", "command"]


class Report:
    """The lines of one part. `keep` stores what there is so far."""

    def __init__(self, title, is_stored):
        self.lines = []
        self.wrong = 0
        self._title = title
        self._is_stored = is_stored
        print(f"## {title}", flush=True)

    def say(self, line=""):
        print(line, flush=True)
        self.lines.append(line)

    def check(self, is_right, what):
        if not is_right:
            self.wrong += 1
            self.say(f"**Wrong**: {what}")

    def keep(self):
        if self._is_stored:
            store(self._title, self.lines)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=int, default=2_000_000)
    parser.add_argument("--only", nargs="+", choices=PARTS)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--keep", type=Path)
    asked = parser.parse_args()
    wrong = 0
    with tempfile.TemporaryDirectory(prefix="hpr-scale-") as folder:
        for part in asked.only or PARTS:
            kept = asked.keep if asked.keep and part in CASES else Path(folder)
            wrong += run(part, kept, asked.points, asked.write)
    print(f"{wrong} wrong")
    sys.exit(wrong > 0)


def run(part, folder, points, is_stored):
    """Runs one part and returns how much was wrong."""
    if part in CASES:
        name, *rest = CASES[part]
        report = Report(f"{name}: {points:,} points", is_stored)
        compare(report, folder / f"{part} {points}", points, part, *rest)
    elif part == "sectors":
        report = Report(f"Sectors of the directions: {points:,} points", is_stored)
        in_sectors(report, folder / part, points)
    else:
        title, check = OTHERS[part]
        report = Report(title, is_stored)
        check(report, folder / part)
    report.keep()
    return report.wrong


@contextmanager
def divided(merged):
    """Merges of at most so many points, sectors of half as many, and horizons of a sixtieth of them.

    So a small cloud is divided among sectors as a large one is.
    """
    before = plan.MERGED_POINTS, sectors.SECTOR_POINTS, plan.HORIZON_POINTS
    plan.MERGED_POINTS, sectors.SECTOR_POINTS, plan.HORIZON_POINTS = merged, merged // 2, merged // 60
    try:
        yield
    finally:
        plan.MERGED_POINTS, sectors.SECTOR_POINTS, plan.HORIZON_POINTS = before


def in_sectors(report, folder, count):
    """Too many points for one merge: the same answers from sectors as from one piece."""
    paths = write(folder, [tile + UTM for tile in cut(city(count), "spatial")], "NumPy")
    viewpoints = [(np.array(at) + UTM).tolist() for at in VIEWPOINTS.values()]
    with divided(count // 20), cluster() as client:
        answers = {
            name: visible_from_tiles(paths, viewpoints, client=client, **options) for name, options in QUESTIONS.items()
        }
        memory = peaks(client)
    ask_whole(folder / "whole", paths, viewpoints, {name: answer.options for name, answer in answers.items()})
    report.say(
        f"Merges take {count // 20:,} points at most, a sector has about {count // 40:,} of its own. \"Own\" is the largest "
        "share of a sector times the number of sectors. \"Held\" are the points of all sectors together, and the largest "
        "sector, as shares of the points that are divided. One merge is enough where no sectors are given."
    )
    report.say()
    report.say("| viewpoint | inversion | divided | sectors | own | held, together | held, largest | rounds | differences |")
    report.say("|---|---|---:|---:|---:|---:|---:|---:|---:|")
    for inversion, answer in answers.items():
        for number, at in enumerate(VIEWPOINTS):
            different = differences(answer[number], np.load(folder / "whole" / f"{inversion} {number}.npy"))
            report.check(different == 0, f"{at}, {inversion}: {different} differences in sectors")
            own = answer.sectors[number]
            if not own:
                report.say(f"| {at} | {inversion} | 0 | – | – | – | – | – | {different} |")
                continue
            every = sum(sector.own for sector in own)
            largest = max(sector.own for sector in own) * len(own) / every
            report.say(
                f"| {at} | {inversion} | {every:,} | {len(own)} | {largest:.2f} "
                f"| {share(sum(sector.held for sector in own), every)} "
                f"| {share(max(sector.held for sector in own), every)} "
                f"| {max(sector.rounds for sector in own)} | {different} |"
            )
            report.check(largest <= 1.5, f"{at}, {inversion}: a sector has {largest:.2f} times its share")
    report.say()
    shown = ", ".join(f"{process} {value:.0f} MB" for process, value in memory.items())
    whole = json.loads((folder / "whole" / "facts.json").read_text())
    report.say(f"Largest memory: {shown}; one piece {whole['memory']:.0f} MB.")
    report.say()


def kill_workers(report, folder):
    """A worker that is killed in any stage changes nothing."""
    paths = write(folder, [tile + UTM for tile in cut(city(300_000), "spatial")], "NumPy")
    viewpoints = [(np.array(VIEWPOINTS[at]) + UTM).tolist() for at in ("street", "oblique")]
    expected = [answer.tobytes() for answer in visible_from_tiles(paths, viewpoints)]
    in_one_merge = ("facts", "neighbors", "horizon_points", "screen", "merge")
    for kernel in (*in_one_merge, "divide", "piece_of", "begin", "blocks_of", "go_on"):
        sizes = nullcontext() if kernel in in_one_merge else divided(30_000)
        with sizes, cluster() as client:
            killer = Killer(client, kernel)
            killer.start()
            answers = visible_from_tiles(paths, viewpoints, client=client, cache=False)
            killer.end()
        same = [answer.tobytes() for answer in answers] == expected
        said = "not hit" if killer.hit is None else "the same bytes" if same else "OTHER BYTES"
        report.say(f"- SIGKILL in `{kernel}`: {said}")
        report.check(same and killer.hit is not None, f"killed in {kernel}")
    report.say()


def kill_command(report, folder):
    """A command that is killed goes on from the finished tiles."""
    paths = write(folder / "tiles", [tile + UTM for tile in cut(city(300_000), "spatial")], "NumPy")
    cameras = folder / "cameras.csv"
    rows = [",".join(map(str, np.array(at) + UTM)) for at in VIEWPOINTS.values()]
    cameras.write_text("\n".join(["x,y,z", *rows]) + "\n")
    kept = kill_when_kept(command(folder / "tiles", cameras, folder / "seen"), folder / "seen" / ".work", 40)
    for output in ("seen", "again"):
        process = command(folder / "tiles", cameras, folder / output)
        report.check(process.wait() == 0, "the command failed")
    same = (folder / "seen/visible.parquet").read_bytes() == (folder / "again/visible.parquet").read_bytes()
    report.say(
        f"SIGKILL when {kept} of {len(paths)} tiles were finished. The same command then went on from them: "
        f"{'the same bytes' if same else 'OTHER BYTES'} as a run in one go."
    )
    report.check(same and kept >= 40 and not (folder / "seen/.work").exists(), "the command killed")
    report.say()


def store(title, lines):
    """Puts a section into RESULTS.md, in place of an older one of the same title."""
    path = HERE / "RESULTS.md"
    text = path.read_text() if path.exists() else HEAD
    machine = f"Python {platform.python_version()}, NumPy {np.__version__}, {os.cpu_count()} processors, {WORKERS} workers"
    body = "\n".join([f"## {title}", "", f"Measured on {time.strftime('%Y-%m-%d')} with {machine}.", "", *lines])
    text = re.sub(rf"## {re.escape(title)}\n.*?(?=\n## |\Z)", "", text, flags=re.DOTALL).rstrip()
    path.write_text(f"{text}\n\n{body.rstrip()}\n")


OTHERS = {
    "workers": ("Workers killed", kill_workers),
    "command": ("The command killed", kill_command),
}

HEAD = """# Tiles against one piece

Written by `npm run test:scale`. A generated city of 1 km² (`city.py`) is cut into tiles. `visible_from_tiles` asks them
on a Dask cluster, `whole.py` asks all points in one cloud. "Merged" are the points that are left when every tile is
screened. Tiles and bytes are skipped for this viewpoint: their box is hidden. Seconds are of a machine at work on other
things, too.
"""

if __name__ == "__main__":
    main()
