"""The points that are left of all tiles, divided among sectors of the directions.

Each sector holds its own points, those near its seams, and boxes around the others. It finds out which of its points
are certainly visible, and which boxes may hide the rest. Their points are sent, until all are decided. So no process
holds all points that are left.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hidden_point_removal import share_visible

from . import statistics
from .engines import tree

#: A sector has about this many points of its own.
SECTOR_POINTS = 10_000_000
#: A box holds at most this many points.
BLOCK = 64
#: Blocks this near to the sector are sent at the start, in mean widths of the blocks as seen.
BAND = 0.3
#: The division is made for about this many directions.
DIRECTIONS = 65_536
#: Directions are computed for so many points at a time.
CHUNK = 1_000_000


@dataclass(frozen=True)
class Sector:
    """What was found for one sector."""

    #: How many points are its own.
    own: int
    #: The largest number of points that it held.
    held: int
    #: How often it asked for more points.
    rounds: int


@dataclass(frozen=True)
class Divided:
    """A part, sorted by sectors and then by blocks of points that are near each other."""

    positions: np.ndarray
    ids: np.ndarray
    #: The first point of each block, and the end.
    starts: np.ndarray
    #: The first block of each sector, and the end.
    sectors: np.ndarray
    #: The boxes of the blocks, and of their directions: (blocks, 2, 3).
    boxes: np.ndarray
    seen: np.ndarray


@dataclass(frozen=True)
class State:
    """One sector in the middle of its work."""

    #: The ids that are certainly visible.
    visible: np.ndarray
    #: The points that are not decided.
    own: np.ndarray
    ids: np.ndarray
    #: Other points that can hide them.
    others: np.ndarray
    #: The boxes of all other points, and where they are: (part, block).
    boxes: np.ndarray
    places: np.ndarray
    #: Which boxes are missing.
    missing: np.ndarray
    report: Sector


def visible_in_sectors(engine, parts, total, horizon, viewpoint, options, progress):
    """The visible ids of all parts, ascending, and a report of each sector."""
    count = max(2, -(-total // SECTOR_POINTS))
    step = max(1, total // DIRECTIONS)
    sampled = engine.map(sample_of, [(part, viewpoint, step) for part in parts], None, None, keep=True)
    sample = tree(engine, statistics.joined, (), sampled, None, None)
    [cuts] = engine.map(cuts_of, [(count, sample)], None, None)
    divided = engine.map(divide, [(part, viewpoint, cuts, count) for part in parts], "divide", progress, keep=True)
    cells = [cell_of(cuts, sector) for sector in range(count)]
    calls = [(part, sector, cells[sector]) for sector in range(count) for part in divided]
    pieces = engine.map(piece_of, calls, None, None, keep=True)
    every = [pieces[start : start + len(parts)] for start in range(0, len(pieces), len(parts))]
    calls = [(own, horizon, viewpoint, options) for own in every]
    states = engine.map(begin, calls, "sectors", progress, keep=True)
    while True:
        wanted = engine.map(missing_of, [(state,) for state in states], None, None)
        asking = [sector for sector in range(count) if wanted[sector]]
        if not asking:
            break
        calls = [(divided[part], blocks) for sector in asking for part, blocks in wanted[sector]]
        sent = iter(engine.map(blocks_of, calls, None, None, keep=True))
        calls = [(states[sector], [next(sent) for _ in wanted[sector]], viewpoint, options) for sector in asking]
        for sector, state in zip(asking, engine.map(go_on, calls, "sectors", progress, keep=True), strict=True):
            states[sector] = state
    answers = engine.map(answer_of, [(state,) for state in states], None, None)
    return np.sort(np.concatenate([ids for ids, _ in answers])), [report for _, report in answers]


def directions(positions, viewpoint):
    """Unit vectors from the viewpoint; zero for points at the viewpoint."""
    apart = np.asarray(positions, np.float64) - np.asarray(viewpoint)
    largest = np.abs(apart).max(axis=1, keepdims=True)
    # Squares neither overflow nor underflow.
    apart /= np.where(largest > 0, largest, 1.0)
    length = np.sqrt((apart**2).sum(axis=1, keepdims=True))
    return apart / np.where(length > 0, length, 1.0)


def sample_of(part, viewpoint, step):
    """The directions of some points of a part."""
    return directions(part.positions[::step], viewpoint)


def cuts_of(count, sample):
    """How the directions are cut into `count` cells, each with about as many directions of the sample.

    A cut is (axis, place, below, above), where below and above are cuts or numbers of cells.
    """
    return _cut(sample, 0, count)


def _cut(sample, first, count):
    if count == 1:
        return first
    lower = count // 2
    axis = int(np.argmax(sample.var(axis=0))) if len(sample) > 0 else 0
    place = float(np.quantile(sample[:, axis], lower / count)) if len(sample) > 0 else 0.0
    below = sample[:, axis] < place
    return axis, place, _cut(sample[below], first, lower), _cut(sample[~below], first + lower, count - lower)


def cell_of(cuts, sector):
    """The lowest and the highest coordinates of the directions of a sector."""
    low, high = np.full(3, -np.inf), np.full(3, np.inf)
    while not isinstance(cuts, int):
        axis, place, below, above = cuts
        first = above
        while not isinstance(first, int):
            first = first[2]
        if sector < first:
            high[axis] = min(high[axis], place)
            cuts = below
        else:
            low[axis] = max(low[axis], place)
            cuts = above
    return low, high


def _sectors_of(seen, cuts, sectors, rows):
    if isinstance(cuts, int):
        sectors[rows] = cuts
        return
    axis, place, below, above = cuts
    is_below = seen[rows, axis] < place
    _sectors_of(seen, below, sectors, rows[is_below])
    _sectors_of(seen, above, sectors, rows[~is_below])


def divide(part, viewpoint, cuts, count):
    """A part as `Divided`."""
    positions = part.positions
    number = np.empty(len(positions), np.int32)
    for start in range(0, len(positions), CHUNK):
        seen = directions(positions[start : start + CHUNK], viewpoint)
        _sectors_of(seen, cuts, number[start : start + CHUNK], np.arange(len(seen)))
    order = np.lexsort((_morton(positions), number))
    positions, number = positions[order], number[order]
    points = np.searchsorted(number, np.arange(count + 1))
    starts = np.concatenate([np.arange(*points[k : k + 2], BLOCK) for k in range(count)])
    sectors = np.searchsorted(starts, points)
    boxes, seen = np.empty((len(starts), 2, 3)), np.empty((len(starts), 2, 3))
    ends = np.append(starts, len(positions))
    for first in range(0, len(starts), CHUNK // BLOCK):
        some = slice(first, min(len(starts), first + CHUNK // BLOCK))
        own = positions[starts[first] : ends[some.stop]]
        _bounds(own, starts[some] - starts[first], boxes[some])
        _bounds(directions(own, viewpoint), starts[some] - starts[first], seen[some])
    return Divided(positions, part.ids[order], ends, sectors, boxes, seen)


def _bounds(points, starts, boxes):
    boxes[:, 0] = np.minimum.reduceat(points, starts, axis=0)
    boxes[:, 1] = np.maximum.reduceat(points, starts, axis=0)


def _morton(positions):
    """A number for each position. Positions with near numbers are mostly near each other."""
    code = np.zeros(len(positions), np.uint64)
    if len(positions) == 0:
        return code
    low, high = positions.min(axis=0), positions.max(axis=0)
    side = max(float((high - low).max()), np.finfo(np.float64).tiny)
    for axis in range(3):
        bits = ((np.asarray(positions[:, axis], np.float64) - low[axis]) / side * (2**21 - 1)).astype(np.uint64)
        for shift, mask in _SPREAD:
            bits = (bits | (bits << np.uint64(shift))) & np.uint64(mask)
        code |= bits << np.uint64(axis)
    return code


#: Moves the bits of a number of 21 bits apart, so that two free bits follow each.
_SPREAD = [
    (32, 0x001F00000000FFFF),
    (16, 0x001F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
]


def piece_of(divided, sector, cell):
    """What a sector gets of a part at the start: own points and ids, near points, boxes and numbers of other blocks."""
    first, end = divided.sectors[sector : sector + 2]
    mine = slice(divided.starts[first], divided.starts[end])
    low, high = cell
    # How far the directions of a block are from the cell.
    apart = np.maximum(divided.seen[:, 0] - high, low - divided.seen[:, 1]).max(axis=1, initial=-np.inf)
    width = (divided.seen[:, 1] - divided.seen[:, 0]).max(axis=1, initial=0.0)
    is_near = apart <= BAND * width.mean() if len(width) > 0 else np.zeros(0, bool)
    is_own = np.zeros(len(is_near), bool)
    is_own[first:end] = True
    far = np.flatnonzero(~is_near & ~is_own)
    near = blocks_of(divided, np.flatnonzero(is_near & ~is_own))
    return divided.positions[mine], divided.ids[mine], near, divided.boxes[far], far


def begin(pieces, horizon, viewpoint, options):
    """The first question of a sector."""
    own, ids, near, boxes, far = zip(*pieces, strict=True)
    own = np.concatenate(own)
    single = horizon.astype(own.dtype)
    others = [single if np.array_equal(single, horizon) else horizon, *near]
    places = [np.column_stack([np.full(len(blocks), part), blocks]) for part, blocks in enumerate(far)]
    start = State(
        visible=np.empty(0, np.uint64),
        own=own,
        ids=np.concatenate(ids),
        others=np.concatenate(others),
        boxes=np.concatenate(boxes),
        places=np.concatenate(places),
        missing=np.empty(0, np.uint32),
        report=Sector(own=len(own), held=0, rounds=0),
    )
    return _ask(start, viewpoint, options)


def blocks_of(divided, blocks):
    """The points of some blocks of a part."""
    return divided.positions[_rows(divided.starts[blocks], divided.starts[np.asarray(blocks) + 1])]


def _rows(starts, ends):
    """The numbers from each start to its end, one after another."""
    lengths = ends - starts
    return np.repeat(starts - np.append(0, np.cumsum(lengths)[:-1]), lengths) + np.arange(lengths.sum())


def go_on(state, sent, viewpoint, options):
    """The next question of a sector, with the points that were missing."""
    is_left = np.ones(len(state.boxes), bool)
    is_left[state.missing] = False
    more = replace(
        state,
        others=np.concatenate([state.others, *sent]),
        boxes=state.boxes[is_left],
        places=state.places[is_left],
    )
    return _ask(more, viewpoint, options)


def _ask(state, viewpoint, options):
    share = share_visible(state.own, state.others, state.boxes, viewpoint, **options)
    is_open = np.zeros(len(state.own) + len(state.others), bool)
    is_open[share.undecided] = True
    needed = share.needed[~is_open[share.needed]]
    given = len(state.own)
    others = [state.own[needed[needed < given]], state.others[needed[needed >= given] - given]]
    report = state.report
    return replace(
        state,
        visible=np.concatenate([state.visible, state.ids[share.visible]]),
        own=state.own[share.undecided],
        ids=state.ids[share.undecided],
        others=np.concatenate(others),
        missing=share.missing,
        report=replace(report, held=max(report.held, len(is_open)), rounds=report.rounds + 1),
    )


def missing_of(state):
    """The blocks that a sector needs: a list of (part, blocks)."""
    places = state.places[state.missing]
    return [(int(part), places[places[:, 0] == part, 1]) for part in np.unique(places[:, 0])]


def answer_of(state):
    return state.visible, state.report
