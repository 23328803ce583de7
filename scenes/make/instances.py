#!/usr/bin/env python3
"""Writes scenes/data/fir.obj and fir.mtl, a fir tree, and forest.txt, where it stands on two hills around a lake.

usage: instances.py [FOLDER]      (default: ../data beside this script; needs nothing but Python)
forest.txt: a line for each tree, the rows of a 3x4 matrix: turned, leaning a little, of its own height.
"""
import math
import pathlib
import random
import sys

TIERS, TIPS = 9, 11          # of branches, and branches of one
HEIGHT, RADIUS = 2.0, 0.55
TREES, SIZE = 3000, 30.0     # how many are tried, half the side of the land
LAKE = 5.2                   # radius


def fir():
    """Positions and triangles by material: a trunk, and tiers of branches that hang over the one below."""
    points, trunk, needles = [], [], []

    def point(x, y, z):
        points.append((x, y, z))
        return len(points)

    around = 7
    low = [point(0.07 * math.cos(2 * math.pi * i / around), -0.05, 0.07 * math.sin(2 * math.pi * i / around))
           for i in range(around)]
    top = point(0, 0.9 * HEIGHT, 0)
    trunk += [(low[i], top, low[(i + 1) % around]) for i in range(around)]
    for tier in range(TIERS):
        share = tier / TIERS
        y, radius = HEIGHT * (0.16 + 0.76 * share), RADIUS * (1 - share) ** 0.9 + 0.04
        apex = point(0, y + 0.2 * HEIGHT * (1 - 0.55 * share), 0)
        turn, ring = 0.7 * tier, []
        for i in range(2 * TIPS):
            a = 2 * math.pi * i / (2 * TIPS) + turn
            tip = i % 2 == 0
            r = radius * (1 + 0.12 * math.sin(5 * a + tier)) if tip else 0.62 * radius
            ring.append(point(r * math.cos(a), y - (0.08 if tip else -0.02) * (1.2 - share), r * math.sin(a)))
        under = point(0, y + 0.05, 0)
        for i, corner in enumerate(ring):
            after = ring[(i + 1) % len(ring)]
            needles += [(corner, apex, after), (after, under, corner)]
    return points, trunk, needles


def land(x, z):
    """Height of the ground."""
    far = math.hypot(x, z)
    rise = max(0.0, far - LAKE - 0.4)
    return 0.018 * rise ** 1.7 * (1 + 0.35 * math.sin(2.2 * math.atan2(z, x) + 0.8)) - 0.02


def land_mesh(cells=40):
    points, faces = [], []
    for j in range(cells + 1):
        for i in range(cells + 1):
            x, z = SIZE * (2 * i / cells - 1), SIZE * (2 * j / cells - 1)
            points.append((x, land(x, z) - 0.03, z))
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i + 1
            faces += [(a, a + cells + 1, a + 1), (a + 1, a + cells + 1, a + cells + 2)]
    return points, faces


def obj_write(file, points, groups, library=None):
    with open(file, "w", encoding="ascii") as out:
        if library:
            out.write(f"mtllib {library}\n")
        for p in points:
            out.write("v %.4g %.4g %.4g\n" % p)
        for material, faces in groups:
            if material:
                out.write(f"usemtl {material}\n")
            for face in faces:
                out.write("f %d %d %d\n" % face)


def forest_write(file):
    rng = random.Random(5)
    with open(file, "w", encoding="ascii") as out:
        out.write("# Where the fir tree stands: rows of 3x4 matrices. Written by make/instances.py.\n")
        for _ in range(TREES):
            x, z = rng.uniform(-SIZE, SIZE), rng.uniform(-SIZE, SIZE)
            turn, height, width = rng.uniform(0, 2 * math.pi), rng.uniform(0.55, 1.35), rng.uniform(0.85, 1.15)
            lean_x, lean_z = rng.gauss(0, 0.03), rng.gauss(0, 0.03)
            far = math.hypot(x, z)
            near_camera = z > 3 and abs(x - 1.5) < 0.5 * z - 0.5
            if near_camera or far < LAKE + 0.9 or rng.random() < 0.75 * math.exp(-(far - LAKE) / 5):
                continue
            c, s = height * width * math.cos(turn), height * width * math.sin(turn)
            rows = (c, lean_x, s, x, 0, height, 0, land(x, z), -s, lean_z, c, z)
            out.write(" ".join("%.4g" % v for v in rows) + "\n")


def main():
    here = pathlib.Path(__file__).resolve().parent
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here.parent / "data"
    points, trunk, needles = fir()
    obj_write(folder / "fir.obj", points, [("bark", trunk), ("needles", needles)], "fir.mtl")
    (folder / "fir.mtl").write_text("newmtl bark\nKd 0.16 0.1 0.06\nnewmtl needles\nKd 0.06 0.13 0.07\n", "ascii")
    obj_write(folder / "land.obj", *(lambda p, f: (p, [(None, f)]))(*land_mesh()))
    forest_write(folder / "forest.txt")


if __name__ == "__main__":
    main()
