"""Threads that ask, append and remove at once: every answer is that of some order of the changes. Threads of one question."""

import threading

import numpy as np
import pytest

from hidden_point_removal import Horizon, HprError, PointCloud, merge_visible

VIEWPOINT = [0.0, 0.0, 5.0]
OPTIONS = {"radius": 100.0}


def in_threads(*tasks):
    """Runs functions at once; raises what one of them raised."""
    raised = []

    def guarded(task):
        try:
            task()
        except BaseException as error:  # A panic is no Exception.
            raised.append(error)

    threads = [threading.Thread(target=guarded, args=(task,)) for task in tasks]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=300)
    assert not any(thread.is_alive() for thread in threads), "a thread waits for ever"
    if raised:
        raise raised[0]


@pytest.mark.parametrize("seed", range(5))
def test_changes_wait_for_questions_and_answers_are_those_of_one_order(seed):
    random = np.random.default_rng(seed)
    parts = [random.uniform(-1, 1, (4000, 3)) for _ in range(6)]
    cloud = PointCloud(parts[0])
    # What the cloud answers after each change, one after another.
    states = []
    twin = PointCloud(parts[0])

    def note():
        states.append((
            twin.visible_from(VIEWPOINT, **OPTIONS).indices.tobytes(),
            twin.coverage([VIEWPOINT], **OPTIONS).tobytes(),
        ))

    note()
    for number, part in enumerate(parts[1:]):
        twin.append(part)
        note()
        twin.remove(np.arange(100 * number, 100 * number + 50, dtype=np.uint32))
        note()
    answers, counts, lengths = [], [], []
    done = threading.Event()

    def change():
        for number, part in enumerate(parts[1:]):
            cloud.append(part)
            cloud.remove(np.arange(100 * number, 100 * number + 50, dtype=np.uint32))
        done.set()

    def ask(question, found):
        while True:
            last = done.is_set()
            found.append(question())
            if last:
                return

    in_threads(
        change,
        lambda: ask(lambda: cloud.visible_from(VIEWPOINT, **OPTIONS).indices.tobytes(), answers),
        lambda: ask(lambda: cloud.coverage([VIEWPOINT], **OPTIONS).tobytes(), counts),
        lambda: ask(lambda: (len(cloud), repr(cloud), cloud.spacing, cloud.skipped)[0], lengths),
    )
    # Each thread sees the changes in their order.
    for found, column in [(answers, 0), (counts, 1)]:
        known = [state[column] for state in states]
        places = [known.index(answer) for answer in found]
        assert places == sorted(places)
        assert found[-1] == known[-1]
    assert lengths == sorted(lengths)


def test_points_join_a_horizon_while_others_are_screened():
    random = np.random.default_rng(9)
    points = random.uniform(-1, 1, (20_000, 3))
    horizon = Horizon(VIEWPOINT, **OPTIONS)
    horizon.add(points[:100])
    left = []

    def screen():
        for _ in range(20):
            left.append(len(horizon.screen(points)))
            horizon.hides_box([-0.1, -0.1, -0.1], [0.1, 0.1, 0.1])
            horizon.visible()

    in_threads(lambda: [horizon.add(part) for part in np.split(points, 20)], screen)
    # More points only hide more.
    assert left == sorted(left, reverse=True)
    assert set(horizon.screen(points)) == set(PointCloud(points).visible_from(VIEWPOINT, **OPTIONS).indices)


def test_threads_of_one_question_change_no_answer():
    random = np.random.default_rng(4)
    # So many that all cores answer by default.
    points = random.normal(size=(210_000, 3))
    cloud = PointCloud(points)
    mask = random.random(len(points)) < 0.5
    viewpoints = random.normal(size=(3, 3)) * 4
    camera = {"camera_to_world": np.eye(4), "fx": 500, "fy": 500, "cx": 320, "cy": 240, "width": 640, "height": 480}

    def answers(**threads):
        options = {"exponent": 2.5, **threads}
        seen = [
            cloud.visible_from(viewpoints[0], **options),
            cloud.visible_from(viewpoints[0], within={"mask": mask}, **options),
            cloud.visible_from_any(viewpoints, **options),
            cloud.visible_from_at_least(2, viewpoints, **options),
            cloud.visible_from_direction([0, 0, -1], **options),
            cloud.visible_from_camera(camera, **options),
        ]
        placed = cloud.place_viewpoints(viewpoints, **options)
        return [
            *((view.indices.tobytes(), view.radius, view.exponent) for view in seen),
            cloud.coverage(viewpoints, **options).tobytes(),
            cloud.illuminate(viewpoints, smoothing=0, **options).tobytes(),
            cloud.sees(viewpoints[0], viewpoints, **options).tobytes(),
            (list(placed.chosen), list(placed.gains)),
        ]

    expected = answers(threads=1)
    for threads in [None, 2, 3]:
        assert answers(threads=threads) == expected


@pytest.mark.parametrize("threads", [0, -1, 257, 1.5, "2", True])
def test_a_wrong_number_of_threads_is_refused(threads):
    cloud = PointCloud([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    with pytest.raises(HprError, match="threads") as refused:
        cloud.visible_from(VIEWPOINT, threads=threads)
    assert refused.value.code == "option"


def test_threads_belong_to_clouds():
    with pytest.raises(HprError, match="threads") as refused:
        merge_visible([], VIEWPOINT, radius=100.0, threads=2)
    assert refused.value.code == "option"
