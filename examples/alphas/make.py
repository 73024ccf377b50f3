#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the images in this folder anew: python3 examples/alphas/make.py. Needs nothing but Python.

scales.png and weave.png repeat without a seam; stars.png is one stamp."""
import math
import pathlib
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


if __name__ == "__main__":
    write_png("scales.png", 128, 16, scales)
    write_png("weave.png", 128, 16, weave)
    write_png("stars.png", 192, 8, stars)
