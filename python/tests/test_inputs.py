"""Points are read as other libraries hold them."""

import numpy as np
import pytest

from hidden_point_removal import HprError, PointCloud, hidden_point_removal

VIEWPOINT = [0.0, 0.0, 4.0]
POINTS = np.random.default_rng(1).normal(size=(500, 3))
SEEN = PointCloud(POINTS).visible_from(VIEWPOINT)


class Cloud:
    """As in Open3D: the points are a sequence that NumPy can read."""

    def __init__(self, points):
        self.points = points


class Tensor:
    """As in torch: `__array__`, and `points` that are something else."""

    points = "none"

    def __array__(self, dtype=None, copy=None):
        return POINTS if dtype is None else POINTS.astype(dtype)


class Lazy:
    def numpy(self):
        return POINTS


@pytest.mark.parametrize(
    "given",
    [
        np.column_stack([POINTS, np.full(500, np.nan)]),
        np.column_stack([POINTS, np.ones((500, 200))]),
        [[*point, 7, 8] for point in POINTS.tolist()],
        Cloud(POINTS),
        Cloud(POINTS.tolist()),
        Tensor(),
        Lazy(),
    ],
    ids=["columns", "features", "lists", "cloud", "cloud of lists", "tensor", "numpy()"],
)
def test_points_are_read_as_they_are(given):
    assert np.array_equal(PointCloud(given).visible_from(VIEWPOINT).indices, SEEN.indices)
    cloud = PointCloud(POINTS[:1])
    cloud.append(given)
    assert len(cloud) == 501
    assert np.array_equal(hidden_point_removal(given, VIEWPOINT, SEEN.radius), SEEN.indices)
    assert np.array_equal(hidden_point_removal(given, VIEWPOINT), SEEN.indices)


def test_columns_keep_their_precision_and_their_masks():
    single = np.column_stack([POINTS, POINTS]).astype(np.float32)
    expected = PointCloud(single[:, :3].copy()).visible_from(VIEWPOINT)
    seen = PointCloud(single).visible_from(VIEWPOINT)
    assert np.array_equal(seen.indices, expected.indices) and seen.radius == expected.radius
    masked = np.ma.array(single, mask=False)
    masked[3, 1] = masked[4, 5] = np.ma.masked
    assert PointCloud(masked, non_finite="skip").skipped == 1


def test_torch_tensors():
    torch = pytest.importorskip("torch")
    tensor = torch.from_numpy(POINTS)
    assert np.array_equal(PointCloud(tensor).visible_from(torch.tensor(VIEWPOINT)).indices, SEEN.indices)


@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("positions-length", POINTS.T),
        ("positions-length", Cloud(POINTS[:, :2])),
        ("positions-type", Cloud("points")),
        ("positions-type", Cloud(None)),
        ("positions-type", object()),
    ],
)
def test_other_things_are_refused(code, given):
    with pytest.raises(HprError) as refused:
        PointCloud(given)
    assert refused.value.code == code, str(refused.value)
