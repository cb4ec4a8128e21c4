"""The same questions for tiles on a cluster and for one cloud in one piece.

Each finished answer is kept in the folder. So a comparison that was ended goes on from there.
"""

from __future__ import annotations

import json
import logging
import subprocess
import sys
import time
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from city import VIEWPOINTS, city, cut, write
from memory import peak_memory, processor_time

from hidden_point_removal.distributed import visible_from_tiles, waves

HERE = Path(__file__).parent
WORKERS = 2
#: The radius of the flipping sphere, in the units of the city.
RADIUS = 200_000.0
QUESTIONS = {"exponential": {}, "sphere": {"radius": RADIUS}}


def cluster():
    from dask.distributed import Client

    # A worker that was killed is no news here.
    settings = {"dashboard_address": None, "memory_limit": 0, "silence_logs": logging.CRITICAL}
    return Client(n_workers=WORKERS, threads_per_worker=1, **settings)


def compare(report, folder, count, how, kind, dtype, offset):
    """The same answers from tiles and from one piece."""
    paths = _tiles(folder / "tiles", (count, how, kind, dtype, offset))
    total = json.loads((folder / "tiles" / "points.json").read_text())
    sizes = np.array([path.stat().st_size for path in paths])
    viewpoints = [(np.array(at) + offset).tolist() for at in VIEWPOINTS.values()]
    report.say(f"{total:,} points in {len(paths)} tiles, {sizes.sum() / 1e6:.1f} MB. Neighboring tiles share points.")
    report.say()
    report.say("| viewpoint | inversion | visible | merged | tiles skipped | bytes skipped | differences |")
    report.say("|---|---|---:|---:|---:|---:|---:|")
    figures = {}
    for inversion, options in QUESTIONS.items():
        figures[inversion], arrays = _from_tiles(folder / inversion, paths, viewpoints, options)
        ask_whole(folder / "whole", paths, viewpoints, {name: known["options"] for name, known in figures.items()})
        for number, at in enumerate(VIEWPOINTS):
            ids, skipped = arrays[f"ids_{number}"], arrays[f"skipped_{number}"]
            different = differences(ids, np.load(folder / "whole" / f"{inversion} {number}.npy"))
            report.say(
                f"| {at} | {inversion} | {share(len(ids), total)} | {share(arrays['survivors'][number], total)} "
                f"| {share(len(skipped), len(paths))} | {share(sizes[skipped].sum(), sizes.sum())} | {different} |"
            )
            report.check(different == 0, f"{at}, {inversion}: {different} differences")
        report.keep()
    whole = json.loads((folder / "whole" / "facts.json").read_text())
    used, own = figures["exponential"]["options"]["inversion"]["exponential"], whole["automatic"]
    off = abs(used / own - 1)
    report.say()
    report.say(
        f"c = {used:.6g} from the tiles, {own:.6g} from one piece ({100 * off:.2f} % off; the whole asked with the "
        f"recorded c gives the answers above)."
    )
    report.check(off < 0.02, f"c is {100 * off:.2f} % off")
    for inversion, known in figures.items():
        stages = ", ".join(f"{stage} {seconds:.0f} s" for stage, seconds in known["stages"].items())
        memory = ", ".join(f"{process} {value:,.0f} MB" for process, value in known["memory"].items())
        report.say()
        report.say(
            f"All viewpoints, {inversion}: {sum(known['stages'].values()):.0f} s ({stages}), {known['processor']:.0f} s of "
            f"the workers' processors. Largest memory: {memory}."
        )
    views = whole["processor"]
    report.say()
    report.say(
        f"One piece: {whole['opened']:.0f} s to read and sort it, {min(views):.1f} to {max(views):.1f} s a view, "
        f"{whole['memory']:,.0f} MB."
    )
    report.say()
    report.keep()
    if how == "spatial":
        street = _from_tiles(folder / "exponential", paths, viewpoints, {})[1]
        _without_waves(report, paths, viewpoints[:1], figures["exponential"]["options"], street["ids_0"])


def _tiles(folder, choices):
    """The paths of the tiles. They are made in a process of its own, so that its memory is not the client's."""
    if not (folder / "points.json").exists():
        maker = get_context("spawn").Process(target=_make, args=(folder, *choices))
        maker.start()
        maker.join()
        if maker.exitcode != 0:
            raise RuntimeError(f"the tiles in {folder} could not be made")
    return sorted(path for path in folder.iterdir() if path.suffix in (".laz", ".npy"))


def _make(folder, count, how, kind, dtype, offset):
    tiles = cut(city(count), how)
    # One tile after another: they are as large as the city.
    write(folder, ((tile + offset).astype(dtype) for tile in tiles), kind)
    # Last, because it says that the tiles are complete.
    (folder / "points.json").write_text(json.dumps(sum(map(len, tiles))))


def _from_tiles(path, paths, viewpoints, options):
    """The figures and the arrays of an answer from tiles."""
    arrays, figures = path.with_suffix(".npz"), path.with_suffix(".json")
    if not figures.exists():
        stages = _Stages()
        with cluster() as client:
            answers = visible_from_tiles(paths, viewpoints, client=client, progress=stages.note, **options)
            known = {
                "options": answers.options,
                "stages": stages.seconds,
                "processor": sum(client.run(processor_time).values()),
                "memory": {"scheduler and client": peak_memory(), **peaks(client)},
            }
        kept = {f"ids_{number}": ids for number, ids in enumerate(answers)}
        kept |= {f"skipped_{number}": np.array(tiles, int) for number, tiles in enumerate(answers.skipped_tiles)}
        np.savez(arrays, survivors=answers.survivors, **kept)
        figures.write_text(json.dumps(known))
    with np.load(arrays) as stored:
        return json.loads(figures.read_text()), dict(stored)


class _Stages:
    """The time that each stage took. Says how far it is."""

    def __init__(self):
        self.seconds = {}
        self._before = time.monotonic()

    def note(self, stage, done, every):
        now = time.monotonic()
        self.seconds[stage] = self.seconds.get(stage, 0.0) + now - self._before
        self._before = now
        if done == every or done % max(1, every // 8) == 0:
            print(f"{time.strftime('%H:%M:%S')} {stage}: {done} of {every}", file=sys.stderr, flush=True)


def _without_waves(report, paths, viewpoint, options, expected):
    """How many tiles the horizon of the samples alone skips."""
    with cluster() as client:
        with_waves = visible_from_tiles(paths, viewpoint, client=client, **options)
        first, waves.FIRST = waves.FIRST, len(paths)
        try:
            without = visible_from_tiles(paths, viewpoint, client=client, **options)
        finally:
            waves.FIRST = first
    report.say(
        f"From the street alone, the horizon of the samples skips {share(without.skipped[0], len(paths))} of the tiles, "
        f"and the waves of near tiles {share(with_waves.skipped[0], len(paths))}; "
        f"{without.survivors[0]:,} and {with_waves.survivors[0]:,} points are merged."
    )
    for answer in (without, with_waves):
        report.check(np.array_equal(answer[0], expected), "the waves change the answer")
    report.say()


def ask_whole(folder, paths, viewpoints, options):
    """Asks one cloud with all points of the tiles, in a process of its own. Its answers are files in the folder."""
    folder.mkdir(exist_ok=True)
    question = folder / "question.json"
    question.write_text(json.dumps({"tiles": list(map(str, paths)), "viewpoints": viewpoints, "options": options}))
    subprocess.run([sys.executable, HERE / "whole.py", question], check=True)


def differences(ids: np.ndarray, expected: np.ndarray) -> int:
    # Both ascend, and are equal as a rule. To list differences takes minutes for 10⁷ points.
    if np.array_equal(ids, expected):
        return 0
    return len(np.setxor1d(ids, expected.astype(np.uint64)))


def peaks(client):
    return {f"worker {number}": peak for number, peak in enumerate(client.run(peak_memory).values(), 1)}


def share(part, whole):
    return f"{100 * part / whole:.1f} %"
