# SPDX-License-Identifier: GPL-3.0-or-later
"""Embosses text: Matplotlib draws it, and its grey is how high the clay rises. Or sinks, with --sunk.

Writes emboss_text.3mf, which can be printed, and emboss_text.png.
"""
import argparse
import pathlib
import tempfile

import argil
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.textpath import TextPath

SIZE = np.array([96.0, 44.0, 10.0])
HEIGHT = 2.0  # of the letters, mm


def draw(text, file, sides):
    """White letters in a frame on black, sides (width, height) in mm, ten pixels for each."""
    figure = plt.figure(figsize=sides / 10, dpi=100, facecolor="black")
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, sides[0]), ylim=(0, sides[1]))
    axes.axis("off")
    path = TextPath((0, 0), text, prop=FontProperties(family="serif", weight="bold"))
    low, high = path.get_extents().get_points()
    scale = min((sides - 14) / (high - low))
    letters = path.vertices * scale - (low + high) / 2 * scale + sides / 2
    axes.add_patch(PathPatch(Path(letters, path.codes), color="white", lw=0))
    axes.add_patch(plt.Rectangle((3, 3), *(sides - 6), fill=False, ec="white", lw=9))
    figure.savefig(file, facecolor="black")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--text", default="Argil")
    parser.add_argument("--sunk", action="store_true", help="letters as hollows")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    clay = argil.Clay.block(SIZE - 3, voxel_mm=0.3)
    clay.offset(1.5)  # round edges
    with tempfile.TemporaryDirectory() as folder:
        draw(given.text, pathlib.Path(folder, "text.png"), SIZE[:2] - 8)
        # One pose is a stamp, as wide as the tool; a flat tool meets the upper side alone.
        half = SIZE[0] / 2 - 4
        clay.stroke([[0, 0, SIZE[2] / 2]], tool="emboss", shape="ellipsoid",
                    radii_mm=[half, half, 4], alpha="text.png", amplitude_mm=HEIGHT,
                    tip_roundness=0.05, strength=-1 if given.sunk else 1, folder=folder)
    report = clay.export(given.out / "emboss_text.3mf")
    print(f"emboss_text.3mf: {report['triangles']} triangles, printable: {report['printable']}")
    picture = argil.render(clay, size=(800, 520), toward=(-0.25, -0.75, 1))
    argil.save_png(given.out / "emboss_text.png", picture)


if __name__ == "__main__":
    main()
