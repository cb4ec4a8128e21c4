"""Which points of a cloud in files can be seen?"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from . import HprError, PointCloud, __version__
from .tiles import KINDS, chunks, visible_from_tiles

# Flags, from src/options.json.
FLAGS = [
    ("radius", "R", "R of the flipping sphere in the cloud's units, or how R is chosen: auto (the default), opposite (the paper's rule, about 40 hulls)"),
    ("exponent", "E", "R = farthest distance · 10^exponent, instead of radius; at least 0"),
    ("inversion", "I", "spherical (the default), power:G (above 1, at most 16), exponential:C or exponential:auto"),
    ("looks", "N", "2 or 3 looks: truer answers than one flip, about 3 times the work; 0 is one flip. The default is 3, and 0 with one of the three options above"),
    ("thickness", "T", "with looks: how far behind the surface before it a point may lie and still be seen; auto (the default): by the cloud's noise"),
    ("surface", "S", "with looks: what the cloud is, if cloud.surface (auto, the default) finds it wrongly: clean, noisy, layered"),
    ("within", "D", "a distance, or X,Y,Z,X,Y,Z, two corners of a box: only these points take part"),
]
# End of flags.


class Parser(argparse.ArgumentParser):
    def error(self, message: str, status: int = 2) -> NoReturn:
        # Names of files may hold characters that would command a terminal.
        self.exit(status, "hidden_point_removal: " + "".join(letter if letter.isprintable() else "?" for letter in message) + "\n")


def main(words: Sequence[str] | None = None) -> None:
    parser = Parser(prog="python -m hidden_point_removal", description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE",
                        help=f"{', '.join(KINDS)}; the points of several are numbered one after another, and one flip answers")  # fmt: skip
    parser.add_argument("--from", dest="eyes", action="append", required=True, type=_place, metavar="X,Y,Z",
                        help="a viewpoint, in the units of the file; may be given again")  # fmt: skip
    parser.add_argument("-o", "--output", action="append", type=Path, metavar="OUT", help="a .npy or .txt file, for the indices of the points that some viewpoint sees")
    for name, value, about in FLAGS:
        parser.add_argument(f"--{name}", action="append", type=_within if name == "within" else _value, metavar=value, help=about.replace("%", "%%"))
    parser.add_argument("--threads", action="append", type=int, metavar="N",
                        help="from 1 to 256; they change no answer. Default: all cores from 200,000 points on, else 1")  # fmt: skip
    parser.add_argument("--version", action="version", version=__version__)
    given = vars(parser.parse_args(_joined(sys.argv[1:] if words is None else words)))
    files, eyes = given.pop("files"), given.pop("eyes")
    for name, values in given.items():
        if values and len(values) > 1:
            parser.error(f"--{name} is given twice")
    options = {name: values[0] for name, values in given.items() if values}
    output = options.pop("output", None)
    if len(files) == 1 and not options.keys() & {"radius", "exponent", "inversion"}:
        options.setdefault("looks", 3)
    if options.get("looks") == 0:
        del options["looks"]
    if output is not None and output.suffix not in (".npy", ".txt"):
        parser.error(f"{output}: the output must be a .npy or .txt file")
    if output is not None and output.resolve() in [file.resolve() for file in files]:
        parser.error(f"{output}: the output must not be an input")
    try:
        # What is wrong is refused before a file is read.
        PointCloud([[0, 0, 0]]).visible_from([0, 0, 0], **options)
    except HprError as problem:
        parser.error(f"--{problem} (--help shows how)")
    try:
        _run(files, eyes, output, options)
    except (HprError, OSError, ImportError) as problem:
        parser.error(str(problem), 1)
    except KeyboardInterrupt:
        sys.exit(130)


def _run(files: list[Path], eyes: list[list[float]], output: Path | None, options: dict[str, Any]) -> None:
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


def _joined(words: Sequence[str]) -> list[str]:
    """argparse insists on `--from=-1,2,3`, so `--from -1,2,3` is changed to that."""
    joined: list[str] = []
    for word in words:
        if joined and re.match(r"-[\d.]", word) and re.fullmatch("--[a-z]+", joined[-1]):
            word = f"{joined.pop()}={word}"
        joined.append(word)
    return joined


def _value(text: str) -> Any:
    """A number, or else a word. KIND:VALUE is a dictionary."""
    kind, colon, value = text.partition(":")
    if colon:
        return {kind: _value(value)}
    try:
        number = float(text)
    except ValueError:
        return text
    return int(number) if number.is_integer() else number


def _place(text: str) -> list[float]:
    numbers = [_value(word) for word in text.split(",")]
    if len(numbers) != 3 or not all(isinstance(number, (int, float)) for number in numbers):
        raise argparse.ArgumentTypeError(f"X,Y,Z is needed, not {text}")
    return numbers


def _within(text: str) -> dict[str, Any]:
    numbers = [_value(word) for word in text.split(",")]
    return {"distance": numbers[0]} if len(numbers) == 1 else {"box": [numbers[: len(numbers) // 2], numbers[len(numbers) // 2 :]]}


if __name__ == "__main__":
    main()
