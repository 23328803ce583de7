#!/usr/bin/env python3
"""Writes scenes/data/lighthouse.obj, .mtl, .png and sea.png: a striped tower on a rock, with door, windows and lantern.

usage: lighthouse.py [FOLDER]      (default: ../data beside this script; needs nothing but Python)
lighthouse.png: the left half is the tower unrolled, the upper right quarter is rock, the lower right paint.
sea.png: repeats over the one square that is the sea.
"""
import math
import pathlib
import struct
import sys
import zlib

SIZE = 512            # texels per side of the texture
SEA_SIZE = 256
SEA_HALF, SEA_REPEATS, SEA_LEVEL = 60, 16, -0.55
SEGMENTS = 48         # around the tower
TOWER_TOP = 2.6       # height of the masonry
TOWER = [(0.56, -0.1), (0.54, 0.1), (0.44, 1.0), (0.37, 1.8), (0.34, TOWER_TOP)]  # radius, height
DOOR = 0.085          # places around the tower are turns from +z to +x
WINDOWS = ((0.115, 0.30, True), (0.07, 0.52, True), (0.115, 0.745, False),    # turns, share of the height, lit
           (0.42, 0.30, True), (0.63, 0.52, False), (0.85, 0.745, True))
PANE = (0.0195, 0.033)  # half a window without its frame: turns, share of the height
ROCK_RINGS, ROCK_SEGMENTS = 28, 72


def hash01(*key):
    """A fixed pseudo-random number in [0,1) for integer keys."""
    h = 2166136261
    for k in key:
        h = ((h ^ (k & 0xFFFFFFFF)) * 16777619) & 0xFFFFFFFF
        h ^= h >> 15
    h = (h * 2246822519) & 0xFFFFFFFF
    return ((h ^ (h >> 13)) & 0xFFFFFF) / 0x1000000


def value_noise(x, y, seed, period=None, period_y=None):
    """Smooth noise in [0,1]; repeats after `period` cells in x, `period_y` in y, where given."""
    ix, iy = math.floor(x), math.floor(y)
    fx, fy = x - ix, y - iy
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)

    def at(i, j):
        return hash01(i % period if period else i, j % period_y if period_y else j, seed)

    low = at(ix, iy) * (1 - fx) + at(ix + 1, iy) * fx
    high = at(ix, iy + 1) * (1 - fx) + at(ix + 1, iy + 1) * fx
    return low * (1 - fy) + high * fy


def fractal(x, y, seed, octaves=4, period=None, period_y=None):
    total, weight = 0.0, 0.0
    for o in range(octaves):
        k = 2 ** o
        total += value_noise(x * k, y * k, seed + o, period and period * k, period_y and period_y * k) / k
        weight += 1 / k
    return total / weight


# --- texture ---------------------------------------------------------------------------------------------------------

def tower_color(u, v):
    """u once around, v from foot to top."""
    red = int(v * 5) % 2 == 0
    base = (176, 38, 30) if red else (232, 226, 212)
    row = math.floor(v * 36)
    column = u * 20 + 0.5 * (row % 2)
    in_x, in_y = column % 1.0, (v * 36) % 1.0
    shade = 0.86 + 0.18 * hash01(math.floor(column) % 20, row, 3)
    if in_x < 0.05 or in_y < 0.1:
        shade *= 0.82                                    # mortar
    shade *= 0.84 + 0.3 * fractal(u * 6, v * 9, 11, 4, 6)  # weather
    color = [c * shade for c in base]
    for window_u, window_v, _ in WINDOWS:
        du, dv = abs(u - window_u), abs(v - window_v)
        if du < PANE[0] + 0.009 and dv < PANE[1] + 0.008:
            color = [46, 40, 36]                         # frame
            if 0.002 < du < PANE[0] and dv < PANE[1] and abs(dv - PANE[1] / 3) > 0.002:
                color = [52, 72, 92]
    # The door ends in a half circle: dv is how far above its middle a point lies, in the unit of du.
    du, dv = abs(u - DOOR), max(0.0, (v - 0.125) * TOWER_TOP / (2 * math.pi * 0.52))
    if math.hypot(du, dv) < 0.055:
        color = [225, 214, 190]
        if math.hypot(du, dv) < 0.043:
            plank = math.floor((u - DOOR) * 110)
            color = [c * (0.8 + 0.3 * hash01(plank, 7)) for c in (24, 92, 96)]
    return color


def rock_color(s, t):
    n = fractal(s * 14, t * 14, 23, 5, 14)
    crack = abs(fractal(s * 6, t * 6, 41, 4, 6) - 0.5)
    shade = max(0.25, 0.9 + 3.2 * (n - 0.5)) * (0.5 if crack < 0.02 else 1.0)
    moss = max(0.0, fractal(s * 4, t * 4, 57, 3, 4) - 0.55) * 2.2
    grey = (104, 96, 86)
    green = (80, 96, 44)
    return [(g * (1 - moss) + m * moss) * shade for g, m in zip(grey, green)]


def paint_color(s, t):
    """Four strips: dark iron, red roof, white gallery, brass."""
    strip = min(3, int(s * 4))
    color = ((44, 46, 50), (150, 34, 28), (214, 210, 200), (190, 150, 70))[strip]
    return [c * (0.9 + 0.2 * fractal(s * 24, t * 24, 71, 3)) for c in color]


def sea_color(u, v):
    """Crests, longer along u; meets itself at all edges."""
    bend = 0.5 * fractal(u * 5, v * 5, 301, 2, 5, 5)
    ridge = 1 - abs(2 * fractal(u * 7 + bend, v * 22 + bend, 311, 4, 7, 22) - 1)
    crest = ridge ** 6
    return [low + (high - low) * crest for low, high in ((10, 120), (34, 160), (44, 170))]


def lighthouse_color(u, v):
    if u < 0.5:
        return tower_color(2 * u, v)
    if v >= 0.5:
        return rock_color(2 * u - 1, 2 * v - 1)
    return paint_color(2 * u - 1, 2 * v)


def write_png(path, size, color):
    """color(u, v) with v = 0 at the bottom, at the middle of every texel."""
    rows = bytearray()
    for y in reversed(range(size)):
        rows.append(0)
        for x in range(size):
            rows.extend(max(0, min(255, round(c))) for c in color((x + 0.5) / size, (y + 0.5) / size))

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    pixels = zlib.compress(bytes(rows), 9)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


# --- mesh ------------------------------------------------------------------------------------------------------------

class Mesh:
    def __init__(self):
        self.lines, self.counts, self.faces = [], {"v": 0, "vt": 0, "vn": 0}, []

    def put(self, kind, values):
        self.lines.append(kind + " " + " ".join(f"{x:.5f}".rstrip("0").rstrip(".") for x in values))
        self.counts[kind] += 1
        return self.counts[kind]

    def corner(self, p, n, uv):
        length = math.sqrt(sum(x * x for x in n))
        return self.put("v", p), self.put("vt", uv), self.put("vn", [x / length for x in n])

    def triangle(self, a, b, c):
        self.faces.append("f " + " ".join("/".join(map(str, x)) for x in (a, b, c)))

    def use(self, material):
        self.faces.append("usemtl " + material)

    def grid(self, corners, low_is_point=False, high_is_point=False):
        """corners[row][column]: quads between neighbours, seen counter-clockwise from outside. Where all of the first
        (last) row lies in one point, the quads are triangles."""
        last = len(corners) - 2
        for row, (low, high) in enumerate(zip(corners, corners[1:])):
            for i in range(len(low) - 1):
                if not (row == 0 and low_is_point):
                    self.triangle(low[i], low[i + 1], high[i + 1])
                if not (row == last and high_is_point):
                    self.triangle(low[i], high[i + 1], high[i])


def lathe(mesh, profile, uv_of):
    """Turns straight pieces of (radius, height) about the y axis; every piece has its own normals: sharp edges."""
    for piece, ((r0, y0), (r1, y1)) in enumerate(zip(profile, profile[1:])):
        rows = []
        for end, (r, y) in enumerate(((r0, y0), (r1, y1))):
            row = []
            for i in range(SEGMENTS + 1):
                a = 2 * math.pi * i / SEGMENTS
                c, s = math.sin(a), math.cos(a)
                slope = r0 - r1
                normal = (c * (y1 - y0), slope, s * (y1 - y0)) if y1 != y0 else (0, 1 if slope > 0 else -1, 0)
                row.append(mesh.corner((r * c, y, r * s), normal, uv_of(piece, i / SEGMENTS, end, y)))
            rows.append(row)
        mesh.grid(rows, r0 == 0, r1 == 0)


def paint_uv(strip):
    return lambda piece, a, end, y: (0.5 + 0.5 * (strip + 0.1 + 0.8 * abs(2 * a - 1)) / 4, 0.5 * (0.1 + 0.8 * end))


def box(mesh, center, half, strip):
    """An axis-aligned post or rail."""
    for axis in range(3):
        for sign in (-1, 1):
            n = [0, 0, 0]
            n[axis] = sign
            b, c = (axis + 1) % 3, (axis + 2) % 3
            quad = []
            for sb, sc in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = list(center)
                p[axis] += sign * half[axis]
                p[b] += sb * half[b]
                p[c] += sc * half[c]
                quad.append(mesh.corner(p, n, (0.5 + 0.5 * (strip + 0.5 + 0.3 * sb) / 4, 0.25 + 0.2 * sc)))
            if sign < 0:
                quad.reverse()
            mesh.triangle(quad[0], quad[1], quad[2])
            mesh.triangle(quad[0], quad[2], quad[3])


def rock_height(x, z):
    r = math.hypot(x, z)
    plateau = 1 / (1 + math.exp((r - 1.15) * 7))
    rough = fractal(x * 1.7 + 9, z * 1.7 + 4, 91, 5) - 0.5
    shore = 0.5 * max(0.0, r - 1.55)
    return -0.75 + 0.75 * plateau - shore + rough * min(1.0, max(0.0, (r - 0.55) / 0.2)) * 1.1


def rock(mesh):
    rows = []
    for ring in range(ROCK_RINGS + 1):
        r = 2.4 * (ring / ROCK_RINGS) ** 0.8
        row = []
        for i in range(ROCK_SEGMENTS + 1):
            a = -2 * math.pi * i / ROCK_SEGMENTS
            x, z, e = r * math.sin(a), r * math.cos(a), 0.02
            slope_x = (rock_height(x + e, z) - rock_height(x - e, z)) / (2 * e)
            slope_z = (rock_height(x, z + e) - rock_height(x, z - e)) / (2 * e)
            s, t = 0.5 + x / 5.2, 0.5 + z / 5.2
            row.append(mesh.corner((x, rock_height(x, z), z), (-slope_x, 1, -slope_z), (0.5 + 0.5 * s, 0.5 + 0.5 * t)))
        rows.append(row)
    mesh.grid(rows, low_is_point=True)


def sea(mesh):
    ends = ((-1, 1), (1, 1), (1, -1), (-1, -1))
    quad = []
    for x, z in ends:
        uv = (SEA_REPEATS * (x + 1) / 2, SEA_REPEATS * (z + 1) / 2)
        quad.append(mesh.corner((SEA_HALF * x, SEA_LEVEL, SEA_HALF * z), (0, 1, 0), uv))
    mesh.triangle(quad[0], quad[1], quad[2])
    mesh.triangle(quad[0], quad[2], quad[3])


def tower_radius(y):
    for (r0, y0), (r1, y1) in zip(TOWER, TOWER[1:]):
        if y0 <= y <= y1:
            return r0 + (r1 - r0) * (y - y0) / (y1 - y0)


def lit_panes(mesh):
    """Six panes of every lit window, a hair in front of the wall that shows their frame."""
    for u, v, lit in WINDOWS:
        if not lit:
            continue
        for side in (-1, 1):
            for low, high in ((-1, -0.38), (-0.28, 0.28), (0.38, 1)):
                quad = []
                for du, dv in ((0.1, low), (0.95, low), (0.95, high), (0.1, high)):
                    a = 2 * math.pi * (u + side * du * PANE[0])
                    y = (v + dv * PANE[1]) * TOWER_TOP
                    r = tower_radius(y) + 0.006
                    c, s = math.sin(a), math.cos(a)
                    quad.append(mesh.corner((r * c, y, r * s), (c, 0, s), (0, 0)))
                mesh.triangle(quad[0], quad[1], quad[2])
                mesh.triangle(quad[0], quad[2], quad[3])


MATERIALS = """newmtl paint
Ka 0.5 0.5 0.5
Kd 1 1 1
map_Kd lighthouse.png

newmtl sea
Ka 0.06 0.1 0.13
Kd 1 1 1
map_Kd sea.png

newmtl lamplight
Ka 0 0 0
Kd 0 0 0
Ke 1.6 0.95 0.36
"""


def lighthouse():
    mesh = Mesh()
    mesh.use("paint")
    rock(mesh)

    def tower_uv(piece, a, end, y):
        return (0.5 * (0.002 + 0.996 * a), max(0.0, y) / TOWER_TOP * 0.996 + 0.002)

    lathe(mesh, TOWER, tower_uv)
    lathe(mesh, [(0.34, 2.52), (0.54, 2.62), (0.54, 2.68), (0.0, 2.68)], paint_uv(2))      # gallery
    lathe(mesh, [(0.22, 2.68), (0.22, 2.8), (0.0, 2.8)], paint_uv(0))                      # foot of the lantern
    lathe(mesh, [(0.0, 3.14), (0.3, 3.14), (0.3, 3.18), (0.07, 3.42), (0.05, 3.5), (0.0, 3.5)], paint_uv(1))  # roof
    lathe(mesh, [(0.0, 3.49), (0.035, 3.5), (0.012, 3.62), (0.0, 3.75)], paint_uv(3))      # spike
    for i in range(8):                                                                     # posts of the lantern
        a = 2 * math.pi * (i + 0.5) / 8
        box(mesh, (0.2 * math.sin(a), 2.97, 0.2 * math.cos(a)), (0.014, 0.18, 0.014), 0)
    for i in range(20):                                                                    # railing
        a = 2 * math.pi * i / 20
        box(mesh, (0.5 * math.sin(a), 2.78, 0.5 * math.cos(a)), (0.01, 0.1, 0.01), 0)
    lathe(mesh, [(0.512, 2.865), (0.512, 2.885), (0.488, 2.885), (0.488, 2.865), (0.512, 2.865)], paint_uv(0))
    mesh.use("sea")
    sea(mesh)
    mesh.use("lamplight")
    lit_panes(mesh)
    return mesh


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent / "data"
    write_png(folder / "lighthouse.png", SIZE, lighthouse_color)
    write_png(folder / "sea.png", SEA_SIZE, sea_color)
    mesh = lighthouse()
    head = "# written by scenes/make/lighthouse.py\n"
    (folder / "lighthouse.mtl").write_text(head + MATERIALS)
    (folder / "lighthouse.obj").write_text(head + "mtllib lighthouse.mtl\n" + "\n".join(mesh.lines + mesh.faces) + "\n")
    print(f"{mesh.counts['v']} vertices, {sum(line.startswith('f') for line in mesh.faces)} triangles")


if __name__ == "__main__":
    main()
