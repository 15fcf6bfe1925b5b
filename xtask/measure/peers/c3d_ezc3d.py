"""What ezc3d reads from C3D files, as blocks of numbers.

usage: c3d_ezc3d.py OUTPUT_FOLDER FILE.c3d ..
Writes OUTPUT_FOLDER/N.blocks for the Nth file (from 0) and prints the version of ezc3d. A file of blocks holds, one after
the other: a line `name rows columns`, then rows * columns little-endian doubles, row by row. Names: `points` (a row for
each point, x y z of each frame; not-a-number where it was not seen), `channels` (a row for each channel), and where it
reads force plates `plate_forces` [N] and `plate_centers` [m] (a row for each plate, x y z of each sample). A file that ezc3d
refuses has the single line `refused REASON`.
"""
import sys

import ezc3d
import numpy as np


def block(name, rows):
    rows = np.ascontiguousarray(rows, dtype="<f8")
    return f"{name} {rows.shape[0]} {rows.shape[1]}\n".encode() + rows.tobytes()


def blocks(path):
    try:
        record = ezc3d.c3d(path)
    except Exception as error:
        return f"refused {' '.join(str(error).split())}\n".encode()
    points = record["data"]["points"][:3].transpose(1, 2, 0)
    channels = record["data"]["analogs"][0]
    return block("points", points.reshape(points.shape[0], -1)) + block("channels", channels) + plates(path)


def plates(path):
    try:
        platforms = ezc3d.c3d(path, extract_forceplat_data=True)["data"]["platform"]
    except Exception:
        return b""
    if not platforms:
        return b""
    metres = {"mm": 1e-3, "cm": 1e-2}
    forces = [platform["force"].T.ravel() for platform in platforms]
    centers = [
        platform["center_of_pressure"].T.ravel() * metres.get(platform["unit_position"], 1.0) for platform in platforms
    ]
    return block("plate_forces", forces) + block("plate_centers", centers)


for number, path in enumerate(sys.argv[2:]):
    with open(f"{sys.argv[1]}/{number}.blocks", "wb") as output:
        output.write(blocks(path))
print(ezc3d.__version__)
