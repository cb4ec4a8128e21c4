"""hidden-point-removal-tiles FOLDER --from cameras.csv -o OUTPUT: which points of all tiles in a folder are visible?"""

from __future__ import annotations

import argparse
import csv
import json
import shutil
import sys
from pathlib import Path

from . import HprError


def main(arguments=None):
    tiles = argparse.ArgumentParser(prog="hidden-point-removal-tiles", description=__doc__)
    tiles.add_argument("folder", type=Path, help="a folder of .laz, .las, .parquet or .npy files")
    tiles.add_argument("--from", dest="viewpoints", type=Path, required=True,
                       help="a CSV file with the columns x, y, z, one viewpoint a line")
    tiles.add_argument("-o", "--output", type=Path, required=True, help="the folder of the answer")
    tiles.add_argument("--radius", type=float, help="R of the flipping sphere in the units of the tiles")
    tiles.add_argument("--exponential", type=float, help="the scale c of the exponential inversion")
    tiles.add_argument("--share", type=float, default=0.02, help="the share of the points in the horizon")
    tiles.add_argument("--workers", type=int, default=1, help="processes on this machine (needs Dask)")
    tiles.add_argument("--scheduler", help="the address of a Dask scheduler")
    tiles.add_argument("--laz", action="store_true", help="also copy each LAS, LAZ and COPC tile with a dimension `visible`; copies of COPC are "
                       "COPC where PDAL is installed, and LAZ elsewhere")
    chosen = tiles.parse_args(arguments)
    try:
        run(chosen)
    except (HprError, OSError, ImportError, ValueError) as error:
        sys.exit(f"hidden-point-removal-tiles: {printable(str(error))}")
    except KeyboardInterrupt:
        sys.exit(130)


def printable(text):
    """The text in one line. Names and rows of files may hold characters that would command a terminal."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def run(chosen):
    from .distributed import visible_from_tiles, write_parquet
    from .distributed.tiles import tiles_in

    tiles = tiles_in(chosen.folder)
    viewpoints = read_viewpoints(chosen.viewpoints)
    options = {"radius": chosen.radius}
    if chosen.exponential is not None:
        options["inversion"] = {"exponential": chosen.exponential}
    chosen.output.mkdir(parents=True, exist_ok=True)
    # What is left of finished tiles. The command goes on from there if it was ended.
    work = chosen.output / ".work"
    with _client(chosen) as client:
        answers = visible_from_tiles(
            tiles, viewpoints, client=client, share=chosen.share, work=work, progress=_say, **options
        )
    write_parquet(chosen.output / "visible.parquet", answers)
    report = {
        "tiles": [tile.name for tile in tiles],
        "nodes_and_tiles": answers.tiles,
        "viewpoints": viewpoints,
        "options": answers.options,
        "visible": [len(answer) for answer in answers],
        "skipped_tiles": answers.skipped,
        "survivors": answers.survivors,
    }
    (chosen.output / "report.json").write_text(json.dumps(report, indent=2) + "\n")
    if chosen.laz:
        copy(tiles, answers, chosen.output)
    shutil.rmtree(work, ignore_errors=True)
    for number, count in enumerate(report["visible"]):
        print(f"viewpoint {number}: {count} points visible, {answers.skipped[number]} of {answers.tiles} tiles skipped")


def copy(tiles, answers, output):
    """Copies each LAS, LAZ and COPC tile with the dimension `visible`."""
    from .distributed import read_tile, write_copc, write_laz

    first, names = 0, {tile.name for tile in tiles}
    for tile in tiles:
        name = tile.name.lower()
        if name.endswith((".laz", ".las")):
            laz = output / (tile.name[: -len(".copc.laz")] + ".laz" if name.endswith(".copc.laz") else tile.name)
            if laz.name != tile.name and laz.name in names:
                raise ValueError(f"{tile.name} cannot be copied as {laz.name}: another tile has this name")
            write_laz(tile, laz, first, answers)
            if laz.name != tile.name and not write_copc(laz, output / tile.name):
                said = (
                    f"{tile.name} was copied as {laz.name}, which is not a COPC file: the program pdal is not "
                    f"installed. It makes one: pdal translate {laz.name} {tile.name} --writers.copc.forward=all"
                )
                print(printable(said), file=sys.stderr)
        first += len(read_tile(tile))


def read_viewpoints(path):
    """The rows of a CSV file with the columns x, y, z, or of three columns without names."""
    with open(path, newline="") as file:
        rows = [row for row in csv.reader(file) if any(cell.strip() for cell in row)]
    names = [cell.strip().lower() for cell in rows[0]] if rows else []
    columns = [0, 1, 2]
    if {"x", "y", "z"} <= set(names):
        columns = [names.index(axis) for axis in "xyz"]
        rows = rows[1:]
    places = []
    for line, row in enumerate(rows, 1):
        try:
            places.append([float(row[column]) for column in columns])
        except (ValueError, IndexError):
            raise ValueError(f"{path}: row {line} has no three numbers: {', '.join(row)}") from None
    if not places:
        raise ValueError(f"{path} holds no viewpoints")
    return places


def _client(chosen):
    from contextlib import nullcontext

    if chosen.scheduler is None and chosen.workers <= 1:
        return nullcontext()
    from dask.distributed import Client

    if chosen.scheduler is not None:
        return Client(chosen.scheduler)
    return Client(n_workers=chosen.workers, threads_per_worker=1, dashboard_address=None)


def _say(stage, done, every):
    end = "\n" if done == every else "\r"
    print(f"{stage}: {done} of {every}", end=end, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
