# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 smaller_png.py PICTURE...

Makes an 8-bit RGB picture of the window as small as half by what hardly anybody sees: the background's
gradient, which is dithered, becomes bands of one colour; all else is rounded to multiples of 4.
"""
import struct
import sys
import zlib

ROUNDED = bytes(min(255, (v + 2) // 4 * 4) for v in range(256))


def chunks(png):
    at = 8
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        yield kind, png[at + 8:at + 8 + length]
        at += 12 + length


def paeth(left, up, corner):
    guess = left + up - corner
    return min((left, up, corner), key=lambda each: abs(guess - each))


def unfiltered(data, width, height):
    """The rows, by section 9 of the PNG specification."""
    stride = 3 * width
    above = bytes(stride + 3)
    for y in range(height):
        kind, *values = data[y * (stride + 1):(y + 1) * (stride + 1)]
        row = bytearray(3)
        for x, value in enumerate(values, 3):
            left, up, corner = row[x - 3], above[x], above[x - 3]
            guess = (0, left, up, (left + up) // 2, paeth(left, up, corner))[kind]
            row.append((value + guess) & 255)
        yield bytes(row[3:])
        above = row


def banded(row):
    """A row with its background, a bluish grey, in bands, and the rest rounded."""
    smaller = bytearray(row.translate(ROUNDED))
    for x in range(0, len(row), 3):
        red, green, blue = row[x:x + 3]
        if 38 <= green <= 96 and 0 <= green - red <= 3 and 1 <= blue - green <= 5:
            smaller[x:x + 3] = (green | 1) - 1, green | 1, (green | 1) + 3
    return bytes(smaller)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


for name in sys.argv[1:]:
    with open(name, "rb") as file:
        png = file.read()
    header = next(data for kind, data in chunks(png) if kind == b"IHDR")
    width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", header)
    if (depth, color, interlaced) != (8, 2, 0):
        sys.exit(f"{name}: not a plain 8-bit RGB picture; give one that a window's script has taken")
    data = zlib.decompress(b"".join(data for kind, data in chunks(png) if kind == b"IDAT"))
    rows = b"".join(b"\0" + banded(row) for row in unfiltered(data, width, height))
    with open(name, "wb") as file:
        file.write(png[:8] + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
                   chunk(b"IEND", b""))
