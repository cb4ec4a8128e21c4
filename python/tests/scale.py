"""Tiles against one cloud: python scale.py [--points 5000000] [--files 16]

Cuts a generated city into LAZ files and asks it from five viewpoints: as one cloud, by the plain lines below, by
`visible_from_tiles`, by a process that is killed and goes on, and on a Dask cluster whose worker is killed. Each runs in a
process of its own. Ends with status 1 if an answer differs, or if the tiles take more than 1.1 times the processor time or
memory of the plain lines.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import laspy
import numpy as np

from hidden_point_removal import Horizon, PointCloud, merge_visible
from hidden_point_removal.tiles import visible_from_tiles

#: Map coordinates (UTM), as surveys have them.
UTM = np.array([636_000.0, 849_000.0, 400.0])
#: On a street, in a house, in the plane of a wall, from the side, from above.
PLACES = [[500, 502, 1.7], [445, 445, 3], [430, 500, 1.7], [-300, -400, 350], [500, 500, 1500]]
EYES = [(np.array(place) + UTM).tolist() for place in PLACES]
OPTIONS = {"inversion": {"exponential": 1.0}}


def city(count, seed=1):
    """Ground, walls and roofs on a square of 1 km, in whole millimetres: (count, 3)."""
    random = np.random.default_rng(seed)
    # Two by two houses of 30 m in each block of 100 m, with streets of 20 m around the blocks.
    starts = np.array([block + at for block in range(0, 1000, 100) for at in (10.0, 60.0)])
    houses = np.stack(np.meshgrid(starts, starts, indexing="ij"), axis=-1).reshape(-1, 2)
    heights = np.random.default_rng(5).uniform(8, 60, len(houses))
    ground, walls, roofs = random.multinomial(count, [0.4, 0.45, 0.15])
    parts = [np.column_stack([random.uniform(0, 1000, (ground, 2)), random.normal(0, 0.02, ground)])]
    house, along, across = random.integers(0, 400, walls), random.uniform(0, 30, walls), random.choice([0.0, 30.0], walls)
    turned = random.random(walls) < 0.5
    sides = np.column_stack([np.where(turned, along, across), np.where(turned, across, along)])
    parts.append(np.column_stack([houses[house] + sides, random.uniform(0, 1, walls) * heights[house]]))
    house = random.integers(0, 400, roofs)
    parts.append(np.column_stack([houses[house] + random.uniform(0, 30, (roofs, 2)), heights[house]]))
    return np.round(np.concatenate(parts), 3) + UTM


def write(folder, count, files):
    """The city in squares of the ground, as LAZ files."""
    points, side = city(count), round(files**0.5)
    column, row = (np.clip((points - UTM)[:, axis] * side / 1000, 0, side - 1).astype(int) for axis in (0, 1))
    for number in range(side * side):
        las = laspy.LasData(laspy.LasHeader(point_format=6, version="1.4"))
        las.header.scales, las.header.offsets = [0.001] * 3, UTM
        las.x, las.y, las.z = points[row * side + column == number].T
        las.write(folder / f"{number:03}.laz")


def whole(paths, _folder):
    cloud = PointCloud(np.concatenate([laspy.read(path).xyz for path in paths]))
    return [cloud.visible_from(eye, **OPTIONS).indices.astype(np.uint64) for eye in EYES]


def plain(paths, _folder):
    """What is asked of tiles, in the fewest lines."""
    counts = [laspy.open(path).header.point_count for path in paths]
    horizons = [Horizon(eye, **OPTIONS) for eye in EYES]
    for path in paths:
        sample = laspy.read(path).xyz[::50]
        for horizon in horizons:
            horizon.add(sample)
    parts = [[] for _ in EYES]
    for path, first in zip(paths, np.cumsum([0, *counts])):
        xyz = laspy.read(path).xyz
        for eye, horizon, part in zip(EYES, horizons, parts):
            left = horizon.screen(xyz)
            keep = PointCloud(xyz[left]).visible_from(eye, **OPTIONS).indices
            part.append((xyz[left[keep]], (left[keep] + first).astype(np.uint64)))
    return [merge_visible(part, eye, **OPTIONS) for part, eye in zip(parts, EYES)]


def tiles(paths, _folder):
    return visible_from_tiles(paths, EYES, **OPTIONS)


def kept(paths, folder):
    return visible_from_tiles(paths, EYES, out=folder / "out", **OPTIONS)


def dask(paths, _folder):
    """On two workers, one of which is killed half-way."""
    from dask.distributed import Client

    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        victims = [*client.run(os.getpid).values()][:1]

        def kill(share):
            if share > 0.5 and victims:
                os.kill(victims.pop(), signal.SIGKILL)

        return visible_from_tiles(paths, EYES, client, kill, **OPTIONS)


WAYS = {way.__name__: way for way in (whole, plain, tiles, kept, dask)}


def one(name, folder):
    """Asks in this process, and prints what it took. Its memory is `VmHWM`: it inherits `ru_maxrss` from its parent."""
    started, clock = time.process_time(), time.monotonic()
    answers = WAYS[name](sorted((folder / "city").glob("*.laz")), folder)
    taken = time.process_time() - started
    status = Path("/proc/self/status")
    lines = status.read_text().splitlines() if status.exists() else []
    memory = next((int(line.split()[1]) // 1024 for line in lines if line.startswith("VmHWM")), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10)
    digest = hashlib.sha256(b"".join(np.asarray(answer, np.uint64).tobytes() for answer in answers)).hexdigest()
    print(json.dumps({"digest": digest, "visible": [len(answer) for answer in answers], "processor": taken, "memory": memory,
                      "seconds": time.monotonic() - clock}))  # fmt: skip


def start(name, folder):
    return subprocess.Popen([sys.executable, __file__, "--way", name, "--folder", folder], stdout=subprocess.PIPE, text=True)


def asked(name, folder):
    output, _ = (process := start(name, folder)).communicate()
    if process.returncode != 0:
        sys.exit(f"{name} failed")
    found = json.loads(output)
    shown = f"{found['processor']:.1f} s of processor time, {found['seconds']:.1f} s, {found['memory']} MiB"
    print(f"{name}: {found['visible']} visible, {shown}", flush=True)
    return found


def killed(folder):
    """Kills the process that keeps results when half of them are there."""
    process, files = start("kept", folder), 2 * len([*(folder / "city").iterdir()])
    while process.poll() is None and len([*(folder / "out").glob("*.npz")]) < 0.75 * files:
        time.sleep(0.01)
    process.kill()
    process.communicate()
    print(f"killed when {len([*(folder / 'out').glob('*.npz')])} of {files} files were there")


def main(folder, points, files):
    (folder / "city").mkdir()
    write(folder / "city", points, files)
    expected, least = asked("whole", folder), asked("plain", folder)
    killed(folder)
    found = {name: asked(name, folder) for name in ("tiles", "kept", "dask")}
    wrong = [f"{name} answers otherwise" for name, one in found.items() if one["digest"] != expected["digest"]]
    own = found["tiles"]
    wrong += [f"tiles take too much {name}" for name in ("processor", "memory") if own[name] > 1.1 * least[name]]
    for problem in wrong:
        print(f"Wrong: {problem}")
    print(f"{len(wrong)} wrong")
    sys.exit(len(wrong) > 0)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=int, default=5_000_000)
    parser.add_argument("--files", type=int, default=16)
    parser.add_argument("--way", choices=WAYS)
    parser.add_argument("--folder", type=Path)
    given = parser.parse_args()
    if given.way:
        one(given.way, given.folder)
    else:
        with tempfile.TemporaryDirectory(prefix="hpr-scale-") as scratch:
            main(Path(scratch), given.points, given.files)
