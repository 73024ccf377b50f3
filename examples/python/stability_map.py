# SPDX-License-Identifier: GPL-3.0-or-later
"""How stiff a coupling may be before a stiff wall makes the hand vibrate, for every delay of the loop.

Runs a simulated hand some hundred times on virtual time. Writes stability_map.png.
"""
import argparse
import pathlib

import argil
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

STIFFNESSES = np.geomspace(200, 3000, 24)  # N/m
DELAYS = np.arange(13)  # ticks of 1 ms
VERDICTS = ("quiet", "buzz", "limit_cycle", "unfinished")
DAMPING = 3.0  # of the handle, N s/m (docs/stability.md)


def hold(stiffness, delay, hand, governor):
    """The verdict on a hand that presses on a wall of 20 kN/m, and by how much the handle swings."""
    report, _ = argil.lab("wall-linear", {"k": 20000}, hand=hand, governor=governor,
                          delay_ticks=int(delay), stiffness_n_per_m=float(stiffness))
    return VERDICTS.index(report["verdict"]), report["position_pp_mm"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)

    figure, axes = plt.subplots(1, 3, figsize=(11.4, 4.4), sharey=True, constrained_layout=True)
    colors = ListedColormap(["#4c9f70", "#e9c46a", "#c8553d", "#bbbbbb"])
    for one, hand, governor in ((axes[0], "push", False), (axes[1], "arm", False),
                                (axes[2], "push", True)):
        runs = np.array([[hold(k, d, hand, governor) for d in DELAYS] for k in STIFFNESSES])
        one.pcolormesh(DELAYS, STIFFNESSES, runs[..., 0], cmap=colors, vmin=-0.5, vmax=3.5,
                       shading="nearest", edgecolors="white", linewidth=0.3)
        if hand == "push" and not governor:
            line = np.linspace(0, 12.5, 100)
            one.plot(line, DAMPING / ((line + 0.5) * 1e-3), "k--",
                     label="b / (T/2 + delay), the handle's own damping")
            one.legend(loc="lower left", fontsize=8)
        kind = "under the governor" if governor else "no governor"
        quiet = np.mean(runs[..., 0] == 0)
        one.set(title=f"hand '{hand}', {kind}", yscale="log", ylim=(190, 3150),
                xlabel="delay, ms", xlim=(-0.5, 12.5))
        print(f"{hand}, {kind}: {quiet:.0%} quiet, swings of at most {runs[..., 1].max():.1f} mm")
    axes[0].set_yticks([200, 500, 1000, 2000, 3000], [200, 500, 1000, 2000, 3000])
    axes[0].set_ylabel("stiffness of the coupling, N/m")
    patches = [plt.Rectangle((0, 0), 1, 1, color=colors(n)) for n in range(3)]
    axes[1].legend(patches, ["quiet", "buzz", "limit cycle"], loc="lower left", fontsize=8)
    figure.savefig(out / "stability_map.png", dpi=80)


if __name__ == "__main__":
    main()
