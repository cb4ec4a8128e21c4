"""Judges views for qhull.ts: Qhull names the visible points, and an exact linear program decides where it differs.

A request is a line of JSON: the flipped points, the visible indices, and the points to judge anyway. So is the answer.
"""

import json
import resource
import sys

import numpy
from scipy.spatial import ConvexHull, QhullError

resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))


def whole(flipped):
    """The points times one power of two, in integers."""
    ratios = [[x.as_integer_ratio() for x in q] for q in flipped]
    unit = max(below for row in ratios for _, below in row)
    return numpy.array([[above * (unit // below) for above, below in row] for row in ratios], dtype=object)


def is_visible(points, i):
    """Whether the ray through point i leaves the hull of all points and the origin there.

    It does not exactly when q is a sum of non-negative multiples of the edges q_j - q and -q. The first phase of the
    simplex method finds such a sum. Its pivots stay in integers (Bareiss).
    """
    q = points[i]
    edges = numpy.vstack([points - q, -q[None]]).T
    table = numpy.hstack([edges, q[:, None]])
    table[q < 0] *= -1
    table = numpy.vstack([table, table.sum(axis=0)])
    before = 1
    for pivots in range(100_000):
        costs = table[-1, :-1]
        entering = numpy.flatnonzero(costs > 0)
        if table[-1, -1] == 0 or entering.size == 0:
            return table[-1, -1] != 0
        # Bland's rule after some pivots, for it cannot cycle; basic columns cost nothing and do not enter.
        column = entering[0] if pivots > 40 else max(entering, key=lambda k: costs[k])
        rows = [r for r in range(len(q)) if table[r, column] > 0]
        row = rows[0]
        for r in rows[1:]:
            if table[r, -1] * table[row, column] < table[row, -1] * table[r, column]:
                row = r
        pivot, chosen = table[row, column], table[row].copy()
        table = (table * pivot - numpy.outer(table[:, column], chosen)) // before
        table[row] = chosen
        before = pivot
    raise RuntimeError("the linear program has no end")


def judged(flipped, visible, anyway):
    # JavaScript writes large numbers without a point, and not with all digits.
    flipped = [[float(x) for x in q] for q in flipped]
    points, ours = whole(flipped), set(visible)
    origin = len(flipped)
    try:
        hull = ConvexHull(numpy.array(flipped + [[0.0] * len(flipped[0])]))
        theirs = set(map(int, hull.vertices)) - {origin}
    except QhullError:
        theirs = None
    different = ours ^ theirs if theirs is not None else set()
    truth = {i: bool(is_visible(points, i)) for i in different.union(anyway)}
    return {
        "refused": theirs is None,
        "different": len(different),
        "theirs": sum(truth[i] != (i in theirs) for i in truth) if theirs is not None else 0,
        "ours": [i for i in sorted(truth) if truth[i] != (i in ours)],
    }


for line in sys.stdin:
    print(json.dumps(judged(**json.loads(line))), flush=True)
