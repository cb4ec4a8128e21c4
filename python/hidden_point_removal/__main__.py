"""Which points of a cloud in files can be seen?"""

from __future__ import annotations

import argparse
import inspect
import json
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import HprError, PointCloud, __version__
from .tiles import KINDS, chunks, visible_from_tiles


def main(words: Sequence[str] | None = None) -> None:
    asks = PointCloud.visible_from
    options = [one.name for one in inspect.signature(asks).parameters.values() if one.kind is one.KEYWORD_ONLY]
    about = dict(re.findall(r"^(\w+): (.+(?:\n    .+)*)", inspect.getdoc(asks) or "", re.MULTILINE))
    parser = argparse.ArgumentParser(prog="python -m hidden_point_removal", description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help=f"{', '.join(KINDS)}; the points of several are numbered one after another")
    parser.add_argument("--from", dest="eyes", action="append", required=True, type=_place, metavar="X,Y,Z",
                        help="a viewpoint, in the units of the file; may be given again; --from=-1,2,3 if it begins with a minus")  # fmt: skip
    parser.add_argument("-o", "--output", type=Path, help="a .npy or .txt file, for the indices of the points that some viewpoint sees")
    parser.add_argument("--version", action="version", version=__version__)
    for name in options:
        parser.add_argument(f"--{name}", type=_value, help=" ".join(about[name].split()).replace("%", "%%"))
    given = vars(parser.parse_args(words))
    try:
        _run(given, {name: given[name] for name in options if given[name] is not None})
    except (HprError, OSError, ImportError) as problem:
        # Names of files may hold characters that would command a terminal.
        sys.exit("hidden_point_removal: " + "".join(letter if letter.isprintable() else "?" for letter in str(problem)))
    except KeyboardInterrupt:
        sys.exit(130)


def _run(given: dict[str, Any], options: dict[str, Any]) -> None:
    files, eyes, output = given["files"], given["eyes"], given["output"]
    if output is not None and (output.suffix not in (".npy", ".txt") or output.resolve() in [file.resolve() for file in files]):
        raise OSError(f"{output}: the output must be another .npy or .txt file")
    seen: list[NDArray[Any]]
    if len(files) == 1:
        cloud = PointCloud(files[0])
        seen = [cloud.visible_from(eye, **options).indices for eye in eyes]
        count = len(cloud)
    else:
        seen = [*visible_from_tiles(files, eyes, **options)]
        count = sum(len(points) for file in files for points in chunks(file))
    for eye, own in zip(eyes, seen):
        print(f"{','.join(map(str, eye))}: {len(own)} of {count} points are visible")
    if output is not None:
        every = np.unique(np.concatenate(seen))
        np.save(output, every) if output.suffix == ".npy" else np.savetxt(output, every, "%d")


def _place(text: str) -> list[float]:
    place = [float(number) for number in text.split(",")]
    if len(place) != 3:
        raise ValueError(text)
    return place


def _value(text: str) -> Any:
    """A number, or {"power": 1.5}, or else a word."""
    try:
        return json.loads(text)
    except ValueError:
        return text


if __name__ == "__main__":
    main()
