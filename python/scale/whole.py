"""python whole.py QUESTION.json ANSWER.npz: the same question for all tiles in one cloud, in a process of its own."""

import json
import sys

import numpy as np

from memory import peak_memory

from hidden_point_removal import PointCloud
from hidden_point_removal.distributed import read_tile


def main(question, answer):
    with open(question) as file:
        asked = json.load(file)
    cloud = PointCloud(np.concatenate([read_tile(tile) for tile in asked["tiles"]]))
    answers = {}
    for number, viewpoint in enumerate(asked["viewpoints"]):
        for name, options in asked["options"].items():
            answers[f"{name} {number}"] = cloud.visible_from(viewpoint, **options).indices
    automatic = cloud.visible_from(asked["viewpoints"][0], inversion={"exponential": "auto"}).inversion["exponential"]
    memory = peak_memory()
    np.savez(answer, automatic=automatic, memory=memory, points=len(cloud), **answers)


main(*sys.argv[1:])
