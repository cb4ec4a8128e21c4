"""python whole.py QUESTION.json: the same question for all tiles in one cloud, in a process of its own.

Each answer becomes a file beside the question. Answers that are there already are not asked again.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np

from memory import peak_memory

from hidden_point_removal import PointCloud
from hidden_point_removal.distributed import read_tile


def main(question):
    folder = Path(question).parent
    asked = json.loads(Path(question).read_text())
    facts = folder / "facts.json"
    known = json.loads(facts.read_text()) if facts.exists() else {"processor": [], "memory": 0.0}
    missing = [
        (folder / f"{name} {number}.npy", viewpoint, options)
        for name, options in asked["options"].items()
        for number, viewpoint in enumerate(asked["viewpoints"])
        if not (folder / f"{name} {number}.npy").exists()
    ]
    if not missing and "automatic" in known:
        return
    started = time.process_time()
    tiles = [read_tile(tile) for tile in asked["tiles"]]
    positions = np.concatenate(tiles)
    del tiles
    cloud = PointCloud(positions)
    known["opened"] = time.process_time() - started
    for path, viewpoint, options in missing:
        started = time.process_time()
        seen = cloud.visible_from(viewpoint, **options).indices
        known["processor"].append(time.process_time() - started)
        np.save(path, seen)
        print(f"{time.strftime('%H:%M:%S')} one piece, {path.stem}: {known['processor'][-1]:.1f} s", file=sys.stderr)
    if "automatic" not in known:
        seen = cloud.visible_from(asked["viewpoints"][0], inversion={"exponential": "auto"})
        known["automatic"] = seen.inversion["exponential"]
    known["memory"] = max(known["memory"], peak_memory())
    facts.write_text(json.dumps(known))


main(*sys.argv[1:])
