"""The thickness at which scanners see the points that they measured."""

from __future__ import annotations

import math

import numpy as np

from . import _arguments as arguments
from ._answers import Calibration
from ._arguments import refusal

#: So many of the points of each station must be seen.
ENOUGH = 0.985
#: The first thickness, in spacings, how often it is doubled at most, and how often halves are tried then.
FIRST = 0.125
DOUBLINGS = 16
HALVINGS = 3


def calibrated(cloud, stations, options):
    """The smallest thickness at which each station sees its own points. A given one is only measured."""
    own = [_station(*entry, len(cloud)) for entry in enumerate(_listed(stations))]
    options = {**options, "looks": 3 if options.get("looks") is None else options["looks"]}

    def trial(thickness):
        asked = {**options, "thickness": thickness}
        masks = ((cloud.visible_from(viewpoint, **asked).mask(), indices) for viewpoint, indices in own)
        return Calibration(thickness, [np.count_nonzero(mask[indices]) / len(indices) for mask, indices in masks], asked)

    given = options.get("thickness")
    is_automatic = given is None or (isinstance(given, str) and given == "auto")
    if not is_automatic or cloud.spacing == 0:
        return trial(0.0 if is_automatic else given)
    best, least = trial(FIRST * cloud.spacing), 0.0
    for _ in range(DOUBLINGS):
        if min(best.recall) >= ENOUGH:
            break
        least, best = best.thickness, trial(2 * best.thickness)
    for _ in range(HALVINGS):
        if least == 0 or min(best.recall) < ENOUGH:
            break
        between = trial(math.sqrt(least * best.thickness))
        if min(between.recall) >= ENOUGH:
            best = between
        else:
            least = between.thickness
    return best


def _listed(stations):
    try:
        listed = list(stations)
    except TypeError:
        listed = []
    if not listed:
        raise refusal("option", f"stations must be a list of at least one station, got {stations!r:.60}")
    return listed


def _station(number, given, length):
    """The viewpoint and the indices of a station of a cloud of so many indices."""
    name = f"stations[{number}]"
    if not isinstance(given, dict):
        raise refusal("option", f"{name} must be a dictionary of viewpoint, and of indices or mask")
    viewpoint, indices, mask = (given.get(entry) for entry in ("viewpoint", "indices", "mask"))
    if viewpoint is None:
        raise refusal("option", f"{name} has no viewpoint")
    if (indices is None) == (mask is None):
        raise refusal("option", f"{name} must have one of indices and mask")
    place = arguments.place(viewpoint, f"the viewpoint of {name}")
    if mask is None:
        own = arguments.indices(indices, f"the indices of {name}", length)
    else:
        marks = arguments.mask(mask, f"the mask of {name}")
        if marks.shape != (length,):
            raise refusal("option", f"{name} must have a mask of {length} truth values, one for each index")
        own = np.flatnonzero(marks)
    if (own >= length).any():
        raise refusal("option", f"{name} has index {own[own >= length][0]}, which must be below {length}")
    if not own.size:
        raise refusal("option", f"{name} has no points")
    return place, own
