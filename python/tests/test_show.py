"""Pictures of answers."""

import numpy as np
import pytest

from hidden_point_removal import HprError, PointCloud, show

POINTS = np.random.default_rng(1).normal(size=(2000, 3)) + [5e5, 0, 0]
CLOUD = PointCloud(POINTS)
SEEN = CLOUD.visible_from([5e5, 0, 9], looks=3)
GREY = [0.8, 0.8, 0.8]


def test_a_figure_shows_visible_points_in_color_and_hidden_ones_in_grey():
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    for cloud, visible in ((CLOUD, SEEN), (POINTS, SEEN.mask()), (CLOUD, SEEN.indices)):
        figure = show(cloud, visible)
        (drawn,) = figure.axes[0].collections
        # Before it is drawn; a drawing sorts the colors by depth.
        is_grey = np.all(drawn._facecolors[:, :3] == GREY, axis=1)
        assert np.array_equal(is_grey, ~SEEN)
        assert np.array_equal(np.transpose(drawn._offsets3d), POINTS)
    assert figure._repr_png_().startswith(b"\x89PNG")
    assert not np.all(show(POINTS).axes[0].collections[0]._facecolors[:, :3] == GREY, axis=1).any()
    large = show(np.random.default_rng(0).normal(size=(150_000, 3)))
    assert len(large.axes[0].collections[0].get_offsets()) == 100_000
    assert show(np.empty((0, 3)))._repr_png_()


def test_what_is_up_is_drawn_up():
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    # 4 units along the axis that is up, 2 and 1 along the others, in the same order around it.
    box = np.random.default_rng(2).random((5000, 3)) * [2, 1, 4]
    places, colors = {}, {}
    for up, turned in (("z", box), ("y", box[:, [1, 2, 0]]), ("-y", box[:, [1, 2, 0]] * [-1, -1, 1])):
        figure = show(turned, up=up)
        figure.canvas.draw()
        (axes,) = figure.axes
        drawn = np.einsum("ij,nj->ni", axes.get_proj(), np.c_[turned, np.ones(5000)])
        places[up], colors[up] = drawn[:, :2] / drawn[:, 3:], show(turned, up=up).axes[0].collections[0]._facecolors
        assert np.corrcoef(places[up][:, 1], box[:, 2])[0, 1] > 0.8, up
        assert np.array_equal(colors[up].round(6), colors["z"].round(6))
    assert np.allclose(places["y"], places["z"])
    with pytest.raises(HprError, match="up must be one of z, y, -y"):
        show(box, up="x")


def test_what_was_removed_is_not_drawn():
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    cloud = PointCloud(POINTS)
    cloud.remove(SEEN)
    assert len(show(cloud).axes[0].collections[0].get_offsets()) == len(POINTS) - len(SEEN)


def test_an_element_gets_the_cloud_as_a_file():
    pytest.importorskip("anywidget", reason="anywidget is not installed")
    widget = show(CLOUD, SEEN, element="https://example.org/hidden-point-cloud.js", up="-y")
    assert widget.get_state()["up"] == "-y" and 'view.up = model.get("up")' in widget._esm
    header, body = widget.file.split(b"end_header\n")
    rows = np.frombuffer(body, [("at", "<f8", 3), ("color", "u1", 3)])
    assert b"element vertex 2000\n" in header and np.array_equal(rows["at"], POINTS)
    assert np.array_equal(np.all(rows["color"] == 204, axis=1), ~SEEN)
    assert widget.element in widget.get_state()["element"] and "export default" in widget._esm


def test_indices_that_the_cloud_does_not_have_are_refused():
    for wrong in ([2000], [-1], np.ones(5, bool), [0.5]):
        with pytest.raises(HprError, match="visible"):
            show(CLOUD, wrong)
