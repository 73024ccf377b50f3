#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the images in this folder anew: python3 examples/alphas/make.py. Needs nothing but Python.

stars.png and medal.png are stamps; all others repeat without a seam. The window offers all of them."""
import math
import pathlib
import random
import struct
import zlib


def write_png(name, side, bits, height):
    """A square grey PNG of height(x, y), 0 to 1, x and y from 0 to 1 from the top left."""
    most = (1 << bits) - 1
    rows = b""
    for j in range(side):
        values = [
            min(max(height((i + 0.5) / side, (j + 0.5) / side), 0.0), 1.0) for i in range(side)
        ]
        packed = [round(value * most) for value in values]
        rows += b"\0" + struct.pack(f">{side}{'H' if bits == 16 else 'B'}", *packed)

    def chunk(kind, data):
        return (
            struct.pack(">I", len(data))
            + kind
            + data
            + struct.pack(">I", zlib.crc32(kind + data))
        )

    head = struct.pack(">IIBBBBB", side, side, bits, 0, 0, 0, 0)
    data = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    (pathlib.Path(__file__).parent / name).write_bytes(b"\x89PNG\r\n\x1a\n" + data)


def scales(x, y):
    """Rows of round scales, four side by side; each hides the upper half of those below it."""
    radius = 0.57
    for row in range(-2, 10):
        for column in range(-1, 6):
            across = 4 * x - (column + 0.5 * (row % 2))
            down = 4 * y - 0.5 * row
            far = math.hypot(across, down) / radius
            if far >= 1.0:
                continue
            # Rising to its lower edge, and rounded there over a tenth.
            edge = min(1.0, (1.0 - far) / 0.1)
            return (0.25 + 0.75 * (down / radius + 1) / 2) * (0.4 + 0.6 * math.sqrt(edge))
    return 0.0


def weave(x, y):
    """Eight bands each way, over one and under the next."""
    band_x, band_y = int(8 * x), int(8 * y)
    along_x = 2 * (8 * y - band_y) - 1  # across a band that runs along x
    along_y = 2 * (8 * x - band_x) - 1

    def band(across, way):
        profile = math.sqrt(max(0.0, 1.0 - (across / 0.92) ** 2))
        return profile * (0.55 + 0.45 * way)

    over = (-1) ** (band_x + band_y)
    return max(
        band(along_x, over * math.cos(0.5 * math.pi * along_y)),
        band(along_y, -over * math.cos(0.5 * math.pi * along_x)),
    )


def stars(x, y):
    """A large star of five points and four small ones, with ridges to their points."""

    def star(mid_x, mid_y, radius, turn):
        across, up = (x - mid_x) / radius, (mid_y - y) / radius
        far = math.hypot(across, up)
        sector = 2 * math.pi / 5
        angle = (math.atan2(across, up) + turn) % sector
        angle = min(angle, sector - angle)  # 0 to the next point
        # Inside the line from a point (far 1) to a notch (far 0.4), by how far it is from it.
        notch = 0.4
        px, py = far * math.cos(angle), far * math.sin(angle)
        nx, ny = notch * math.cos(sector / 2), notch * math.sin(sector / 2)
        inside = ((1 - px) * ny - (0 - py) * (nx - 1)) / math.hypot(nx - 1, ny)
        return max(0.0, inside / 0.38) * radius / 0.38

    small = [star(a, b, 0.14, 0.4) for a in (0.2, 0.8) for b in (0.2, 0.8)]
    return max([star(0.5, 0.52, 0.38, 0.0)] + small)


def scattered(columns, seed, spread):
    """A point in each field of a square grid, up to half `spread` fields off its middle."""
    numbers = random.Random(seed)

    def place():
        return 0.5 + spread * (numbers.random() - 0.5)

    return [[(place(), place()) for _ in range(columns)] for _ in range(columns)]


def nearest_two(points, x, y):
    """How far the two nearest of scattered() are, in fields, and which field the nearest is in."""
    columns = len(points)
    field_x, field_y = int(columns * x), int(columns * y)
    found = []
    for row in range(field_y - 2, field_y + 3):
        for column in range(field_x - 2, field_x + 3):
            across, down = points[row % columns][column % columns]
            far = math.hypot(columns * x - column - across, columns * y - row - down)
            found.append((far, row % columns * columns + column % columns))
    found.sort()
    return found[0][0], found[1][0], found[0][1]


def smooth(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def waves(x, y, seed, count, least, most):
    """A sum of waves with whole numbers of periods each way, about 0, mostly within -1 to 1."""
    numbers = random.Random(seed)
    total = 0.0
    for _ in range(count):
        across, down = numbers.randint(-most, most), numbers.randint(least, most)
        phase = 2.0 * math.pi * numbers.random()
        total += math.cos(2.0 * math.pi * (across * x + down * y) + phase)
    return total * math.sqrt(2.0 / count) / 2.0


PORES = scattered(16, 1, 0.9)
CRACKS = scattered(7, 2, 0.9)
PEBBLES = scattered(9, 3, 0.75)


def pores(x, y):
    """Skin: small round holes in fine folds."""
    near, _, which = nearest_two(PORES, x, y)
    size = 0.3 + 0.2 * (which * 7919 % 97) / 97.0
    hole = smooth(1.0 - near / size)
    return 0.78 - 0.6 * hole + 0.12 * waves(x, y, 11, 24, 5, 14)


def cracks(x, y):
    """Dry mud: flat islands and what parts them."""
    near, next_near, which = nearest_two(CRACKS, x, y)
    edge = smooth((next_near - near) / 0.22)
    return edge * (0.72 + 0.2 * (which * 31 % 17) / 17.0 + 0.06 * waves(x, y, 12, 16, 6, 12))


def pebbles(x, y):
    """Round stones side by side."""
    near, next_near, _ = nearest_two(PEBBLES, x, y)
    inside = min(max((next_near - near) / 0.9, 0.0), 1.0)
    return math.sqrt(1.0 - (1.0 - inside) ** 2)


def bricks(x, y):
    """Four to a row in eight rows, each row half a brick farther."""
    row = int(8 * y)
    across = (4 * x + 0.5 * (row % 2)) % 1.0
    down = (8 * y) % 1.0
    edge = min(2.0 * min(across, 1.0 - across), min(down, 1.0 - down)) - 0.05
    return smooth(edge / 0.07) * (0.86 + 0.1 * waves(x, y, 13, 20, 8, 20))


def bark(x, y):
    """Ridges that run down and part."""
    bent = x + 0.05 * math.sin(2.0 * math.pi * (2 * y + 0.1)) + 0.03 * waves(x, y, 14, 10, 1, 4)
    ridge = abs(math.sin(math.pi * 7 * bent + 1.2 * waves(x, y, 15, 12, 2, 5)))
    return 0.1 + 0.75 * ridge**0.7 + 0.15 * waves(x, y, 16, 24, 6, 16)


def knit(x, y):
    """Eight columns of stitches, each two leaves that lean together."""
    across = (8 * x) % 1.0
    side = 1.0 if across < 0.5 else -1.0
    off = (across % 0.5 - 0.25) / 0.25
    down = (10 * y + 0.55 * side * off) % 1.0
    leaf = 1.0 - off * off
    fibre = 0.06 * math.cos(math.pi * (off + 2.0 * down) * 5)
    return max(0.0, leaf) ** 0.5 * (0.35 + 0.6 * math.sin(math.pi * down) ** 0.6 + fibre)


def medal(x, y):
    """One stamp: a rim, a ring of beads and a rosette of eight leaves."""
    across, up = 2.0 * x - 1.0, 1.0 - 2.0 * y
    far, angle = math.hypot(across, up), math.atan2(across, up)
    rim = smooth(1.0 - abs(far - 0.88) / 0.08)
    bead = (angle / (2.0 * math.pi) * 32) % 1.0 - 0.5
    across_bead = bead * 2.0 * math.pi * 0.72 / 32
    off = math.hypot(across_bead, far - 0.72) / 0.06
    beads = 0.8 * math.sqrt(max(0.0, 1.0 - off * off))
    reach = 0.28 + 0.32 * abs(math.cos(4.0 * angle))
    leaf = smooth(min(1.0, (reach - far) / 0.14)) * (0.55 + 0.35 * abs(math.cos(4.0 * angle)))
    return max(rim, beads, leaf)


if __name__ == "__main__":
    write_png("scales.png", 128, 16, scales)
    write_png("weave.png", 128, 16, weave)
    write_png("stars.png", 192, 8, stars)
    for image in (pores, cracks, pebbles, bricks, bark, knit, medal):
        write_png(image.__name__ + ".png", 256, 8, image)
