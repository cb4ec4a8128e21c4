"""Reads files of points with laspy and lazrs, plyfile and pypcd4, or with Open3D if that is the argument, for foreign.ts.

A request on standard input is the kind (4 bytes), the length and the bytes of a file. The answer is the number of
coordinates and the coordinates, or -1, the length of a message, and the message.
"""

import io
import os
import resource
import struct
import sys
import tempfile

import numpy

if "open3d" in sys.argv:
    import open3d
else:
    import laspy
    from plyfile import PlyData
    from pypcd4 import PointCloud

# A damaged header may ask for any amount of memory.
resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))


def axes(points):
    return numpy.stack([numpy.asarray(points[axis], dtype="<f8") for axis in "xyz"], axis=1)


def read_ply(content):
    return axes(PlyData.read(io.BytesIO(content))["vertex"])


def read_pcd(content):
    cloud = PointCloud.from_fileobj(io.BytesIO(content))
    return axes(cloud.pc_data)


def read_las(content):
    return numpy.asarray(laspy.read(io.BytesIO(content)).xyz, dtype="<f8")


def written(points, colors, intensity):
    """All numbers of a file that writeCloud has made: x, y, z, colors and the intensity of each point."""
    columns = [points[name] for name in [*colors, intensity]]
    return numpy.column_stack([axes(points), *(numpy.asarray(column, dtype="<f8") for column in columns)])


def written_ply(content):
    points = PlyData.read(io.BytesIO(content))["vertex"]
    for color in ["red", "green", "blue"]:
        assert points[color].dtype == numpy.uint8, f"{color} is {points[color].dtype}"
    return written(points, ["red", "green", "blue"], "intensity")


def written_las(content):
    return written(laspy.read(io.BytesIO(content)), ["red", "green", "blue"], "intensity")


def written_open3d(content):
    """Both readers of Open3D: the older one has points and colors alone."""
    with tempfile.NamedTemporaryFile(suffix=".ply") as file:
        file.write(content)
        file.flush()
        points, older = open3d.t.io.read_point_cloud(file.name).point, open3d.io.read_point_cloud(file.name)
    columns = [points[name].numpy().astype("<f8") for name in ["positions", "colors", "intensity"]]
    assert (columns[0] == numpy.asarray(older.points)).all(), "the older reader has other points"
    assert (columns[1] == numpy.rint(255 * numpy.asarray(older.colors))).all(), "the older reader has other colors"
    return numpy.column_stack(columns)


READERS = {
    **{b"ply ": read_ply, b"pcd ": read_pcd, b"las ": read_las},
    **{b"plyw": written_ply, b"lasw": written_las, b"o3dw": written_open3d},
}
# Open3D prints its warnings where the answers are expected.
requests, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
os.dup2(2, 1)
while head := requests.read(8):
    kind, length = struct.unpack("<4sI", head)
    content = requests.read(length)
    try:
        points = READERS[kind](content).ravel()
        answers.write(struct.pack("<i", len(points)) + points.tobytes())
    except BaseException as error:  # lazrs panics with exceptions of its own
        message = f"{type(error).__name__}: {error}"[:200].encode()
        answers.write(struct.pack("<ii", -1, len(message)) + message)
    answers.flush()
