"""Colors of a cloud from the images of COLMAP: colmap_colors.py CLOUD.laz COLMAP/sparse/0 COLMAP/images COLORED.txt"""

import sys
from pathlib import Path

import numpy as np

from hidden_point_removal import PointCloud, read_cameras, transfer

file, model, images, out = sys.argv[1:]
cloud = PointCloud(file)
cameras = read_cameras(model)
colors, seen = transfer(cloud, cameras, [Path(images, camera.image) for camera in cameras], merge="median")
is_colored = seen > 0
np.savetxt(out, np.column_stack([cloud.positions, colors])[is_colored])
print(f"{is_colored.sum()} of {len(cloud)} points have a color")
