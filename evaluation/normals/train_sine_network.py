#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Trains the network of sines that haptics/src/scene/sine_network_weights.h holds, and writes that file.

Usage: evaluation/normals/train_sine_network.py [-o FILE.h] [--quick] [--seed N]

Needs numpy only (Debian's python3-numpy). The program itself does not run this: the weights are in the
repository. Run it again to change the network; four minutes of one core. The seed fixes all that is random;
the last bits depend on the linear algebra that numpy was built with.

What is learnt: the signed distance d, and with it its gradient, to the waves z = A sin(2 pi x) cos(2 pi y) of
equation 3.16 of the Falcon report, all in wavelengths, A = 0.1 (5 mm on waves of 50 mm, the lab's usual ones).

    u  = (sin 2 pi x, cos 2 pi y, z)        periodic, and mirrored where the waves are, by construction
    h1 = sin(2 pi (W1 u + b1))              after V. Sitzmann, J. Martel, A. Bergman, D. Lindell, G. Wetzstein,
    h2 = sin(2 pi (W2 h1 + b2))             "Implicit neural representations with periodic activation
    d  = w3 h2 + b3                         functions", NeurIPS 2020

How: the method of Levenberg and Marquardt on the distance and its gradient together, from several starts; of
them the one is kept that errs least on points that were not trained on.

Where: points from 0.16 below the surface (8 mm of 50), as deep as a handle is pressed, to 0.04 above it. Their
distance is known because they are made by going along the normal from a point of the surface, less than the least
radius of curvature, 0.253. And, with little weight, the rest of the slab |z| < 0.26, where the nearest point is
searched for: there the distance has creases, which the network rounds.
"""
import argparse
import pathlib
import sys

import numpy as np

AMPLITUDE = 0.1
BELOW = 0.16
ABOVE = 0.04
SLAB = 0.26
HIDDEN = 16
TURN = 2.0 * np.pi
GRADIENT_WEIGHT = 0.05  # wavelengths of distance that an error of one in the gradient counts as
FAR_WEIGHT = 0.02


def height(x, y):
    return AMPLITUDE * np.sin(TURN * x) * np.cos(TURN * y)


def normal(x, y):
    n = np.stack([-AMPLITUDE * TURN * np.cos(TURN * x) * np.cos(TURN * y),
                  AMPLITUDE * TURN * np.sin(TURN * x) * np.sin(TURN * y), np.ones_like(x)], axis=1)
    return n / np.linalg.norm(n, axis=1, keepdims=True)


def near_points(random, count):
    """Points near the surface, their distance and its gradient."""
    x, y = random.uniform(-0.5, 0.5, (2, count))
    d = random.uniform(-BELOW, ABOVE, count)
    n = normal(x, y)
    return np.stack([x, y, height(x, y)], axis=1) + d[:, None] * n, d, n


def searched_distance(points):
    """The distance of each point, by grids that close in on the nearest point of the surface."""
    center, half, steps = points[:, :2].copy(), 0.5, 41
    for _ in range(7):
        offset = np.linspace(-half, half, steps)
        x = center[:, 0, None, None] + offset[None, :, None]
        y = center[:, 1, None, None] + offset[None, None, :]
        square = ((x - points[:, 0, None, None]) ** 2 + (y - points[:, 1, None, None]) ** 2
                  + (height(x, y) - points[:, 2, None, None]) ** 2).reshape(len(points), -1)
        best = square.argmin(axis=1)
        center += np.stack([offset[best // steps], offset[best % steps]], axis=1)
        half, steps = 2.0 * 2.0 * half / (steps - 1), 13
    side = np.sign(points[:, 2] - height(points[:, 0], points[:, 1]))
    return side * np.sqrt(square.min(axis=1))


def far_points(random, count):
    """Points of the slab that are not near the surface, and their distance."""
    points = np.stack([*random.uniform(-0.5, 0.5, (2, 4 * count)), random.uniform(-SLAB, SLAB, 4 * count)],
                      axis=1)
    d = searched_distance(points)
    far = (d < -BELOW) | (d > ABOVE)
    return points[far][:count], d[far][:count]


def inputs(points):
    """u, and how each of its parts grows along its own axis."""
    x, y, z = points.T
    u = np.stack([np.sin(TURN * x), np.cos(TURN * y), z], axis=1)
    return u, np.stack([TURN * np.cos(TURN * x), -TURN * np.sin(TURN * y), np.ones_like(z)], axis=1)


class Network:
    """Weights in turns, in one vector."""

    SHAPES = [("w1", (HIDDEN, 3)), ("b1", (HIDDEN,)), ("w2", (HIDDEN, HIDDEN)), ("b2", (HIDDEN,)),
              ("w3", (HIDDEN,)), ("b3", (1,))]

    def __init__(self, vector):
        self.vector, at = vector, 0
        for name, shape in self.SHAPES:
            size = int(np.prod(shape))
            setattr(self, name, vector[at:at + size].reshape(shape))
            at += size

    @classmethod
    def random(cls, random):
        """Spread as Sitzmann et al. ask, so that each layer's sums have the spread of the one before."""
        w1 = random.uniform(-0.25, 0.25, (HIDDEN, 3)) * [1.0, 1.0, 1.0 / AMPLITUDE / 2.0]
        w2 = random.uniform(-1, 1, (HIDDEN, HIDDEN)) * np.sqrt(6.0 / HIDDEN) / TURN
        w3 = random.uniform(-1, 1, HIDDEN) * AMPLITUDE / np.sqrt(HIDDEN)
        b1, b2 = random.uniform(-0.5, 0.5, (2, HIDDEN))
        return cls(np.concatenate([w1.ravel(), b1, w2.ravel(), b2, w3, [0.0]]))

    def answer(self, points):
        """Distance and gradient."""
        u, grow = inputs(points)
        a1 = TURN * (u @ self.w1.T + self.b1)
        a2 = TURN * (np.sin(a1) @ self.w2.T + self.b2)
        d = np.sin(a2) @ self.w3 + self.b3[0]
        p1 = (TURN * np.cos(a2) * self.w3) @ self.w2 * TURN * np.cos(a1)
        return d, (p1 @ self.w1) * grow

    def rows(self, points, with_gradient):
        """For each point d, and with its three slopes, and the derivatives of each by all weights."""
        u, grow = inputs(points)
        a1 = TURN * (u @ self.w1.T + self.b1)
        h1, k1 = np.sin(a1), TURN * np.cos(a1)
        a2 = TURN * (h1 @ self.w2.T + self.b2)
        h2, k2 = np.sin(a2), TURN * np.cos(a2)
        count = len(points)
        p2 = k2 * self.w3
        p1 = (p2 @ self.w2) * k1
        by_weight = np.concatenate([(p1[:, :, None] * u[:, None, :]).reshape(count, -1), p1,
                                    (p2[:, :, None] * h1[:, None, :]).reshape(count, -1), p2, h2,
                                    np.ones((count, 1))], axis=1)
        values, jacobian = [h2 @ self.w3 + self.b3[0]], [by_weight]
        for axis in range(3 if with_gradient else 0):
            t1 = k1 * self.w1[:, axis]
            along = t1 @ self.w2.T
            t2 = k2 * along
            bend2 = -TURN ** 2 * h2 * along * self.w3  # of p2, when a2 moves
            to1, bend1 = p2 @ self.w2, bend2 @ self.w2
            r1 = -TURN ** 2 * h1 * self.w1[:, axis] * to1 + bend1 * k1
            by_w1 = r1[:, :, None] * u[:, None, :]
            by_w1[:, :, axis] += to1 * k1
            by_w2 = p2[:, :, None] * t1[:, None, :] + bend2[:, :, None] * h1[:, None, :]
            by_weight = np.concatenate([by_w1.reshape(count, -1), r1, by_w2.reshape(count, -1), bend2, t2,
                                        np.zeros((count, 1))], axis=1)
            values.append(t2 @ self.w3 * grow[:, axis])
            jacobian.append(by_weight * grow[:, axis, None])
        return values, jacobian


class Lessons:
    """What is trained on: weighted residuals and their normal equations."""

    def __init__(self, random, near, far):
        self.near, self.far = near_points(random, near), far_points(random, far)

    def residuals_of(self, network):
        d, g = network.answer(self.near[0])
        far = network.answer(self.far[0])[0]
        return np.concatenate([d - self.near[1], GRADIENT_WEIGHT * (g - self.near[2]).ravel(),
                               FAR_WEIGHT * (far - self.far[1])])

    def cost(self, network):
        return float(np.sum(self.residuals_of(network) ** 2))

    def equations(self, network):
        size = len(network.vector)
        matrix, right = np.zeros((size, size)), np.zeros(size)

        def add(jacobian, residual, weight):
            nonlocal matrix, right
            scaled = weight * jacobian
            matrix += scaled.T @ scaled
            right += scaled.T @ (weight * residual)

        points, d, n = self.near
        for begin in range(0, len(points), 2000):
            part = slice(begin, begin + 2000)
            values, jacobian = network.rows(points[part], True)
            add(jacobian[0], values[0] - d[part], 1.0)
            for axis in range(3):
                add(jacobian[1 + axis], values[1 + axis] - n[part, axis], GRADIENT_WEIGHT)
        values, jacobian = network.rows(self.far[0], False)
        add(jacobian[0], values[0] - self.far[1], FAR_WEIGHT)
        return matrix, right


def train(network, lessons, steps):
    damping, cost = 1e-2, lessons.cost(network)
    for _ in range(steps):
        matrix, right = lessons.equations(network)
        scale = np.diag(matrix) + 1e-9 * np.trace(matrix) / len(right)
        for _ in range(12):
            step = np.linalg.solve(matrix + damping * np.diag(scale), right)
            tried = Network(network.vector - step)
            tried_cost = lessons.cost(tried)
            if tried_cost < cost:
                break
            damping *= 4.0
        else:
            return network  # no step is better
        gain = 1.0 - tried_cost / cost
        network, cost, damping = tried, tried_cost, max(damping / 5.0, 1e-12)
        if gain < 1e-5:
            break
    return network


def errors(network, random, count):
    """(rms, greatest) of the distance in wavelengths, and of the normal in degrees, near the surface."""
    points, d, n = near_points(random, count)
    found, g = network.answer(points)
    off = found - d
    angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(g, n), axis=1), np.sum(g * n, axis=1)))
    return tuple(f(v) for v in (off, angle) for f in (lambda v: np.sqrt(np.mean(v ** 2)),
                                                      lambda v: np.abs(v).max()))


def array_text(name, values, indent="    "):
    words = [f"{np.float32(v):.9g}" for v in np.ravel(values)]
    words = [(w if any(c in w for c in ".e") else w + ".0") + "F" for w in words]
    lines, line = [], indent
    for word in words:
        if len(line) + len(word) + 2 > 99:
            lines.append(line.rstrip())
            line = indent
        line += word + ", "
    lines.append(line.rstrip().rstrip(","))
    return f"    /*{name}=*/\n    {{" + "\n".join(lines).lstrip() + "},\n"


def header_text(network, found, seed):
    rms_d, most_d, rms_n, most_n = found
    text = f"""// SPDX-License-Identifier: GPL-3.0-or-later
// Written by evaluation/normals/train_sine_network.py, seed {seed}; how and on what is said there.
//
// On points that were not trained on, from 0.16 wavelengths below the surface to 0.04 above it:
// distance off by {rms_d:.2g} wavelengths rms, {most_d:.2g} at most; normal by {rms_n:.2g} degrees
// rms, {most_n:.2g} at most.
#pragma once

#include "scene/sine_network_sums.h"

namespace argil::haptics {{

// clang-format off
inline constexpr SineNetworkWeights kSineNetworkWeights{{
"""
    for name, values in (("first", network.w1.T), ("first_bias", network.b1), ("second", network.w2.T),
                         ("second_by_unit", network.w2), ("second_bias", network.b2), ("last", network.w3)):
        text += array_text(name, values)
    text += f"    /*last_bias=*/{np.float32(network.b3[0]):.9g}F\n}};\n// clang-format on\n\n"
    return text + "}  // namespace argil::haptics\n"


def main():
    here = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", default=here / "haptics/src/scene/sine_network_weights.h",
                        type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=364)
    parser.add_argument("--quick", action="store_true", help="a try of seconds: not what is in the repository")
    options = parser.parse_args()
    random = np.random.default_rng(options.seed)
    lessons = Lessons(random, *((600, 200) if options.quick else (3000, 800)))
    best, best_error = None, np.inf
    for start in range(2 if options.quick else 3):
        network = train(Network.random(random), lessons, 5 if options.quick else 30)
        found = errors(network, np.random.default_rng(options.seed + 1), 20000)
        print(f"start {start}: distance {found[0]:.3g} rms, {found[1]:.3g} most; "
              f"normal {found[2]:.3g} deg rms, {found[3]:.3g} most", file=sys.stderr)
        if found[2] < best_error:
            best, best_error = network, found[2]
    best = train(best, lessons, 5 if options.quick else 150)
    best = Network(best.vector.astype(np.float32).astype(np.float64))
    found = errors(best, np.random.default_rng(options.seed + 2), 200000)
    options.output.write_text(header_text(best, found, options.seed))
    print(f"wrote {options.output}: distance {found[0]:.3g} rms, {found[1]:.3g} most, in wavelengths; "
          f"normal {found[2]:.3g} deg rms, {found[3]:.3g} most")


if __name__ == "__main__":
    main()
