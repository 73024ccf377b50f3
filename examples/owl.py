#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes owl.strokes.jsonl: an owl on a branch, sculpted from a ball.

Usage: python3 owl.py > owl.strokes.jsonl

Millimetres, z up, the owl looks along -y. Large forms come first, then the face, then the plumage
in rows from below, so that every feather lies over the one beneath it.
"""
import json
import math

PLAIN = (1.0, 0.0, 0.0, 0.0)
strokes = []


# ---- vectors -------------------------------------------------------------------------------------
def add(a, b, s=1.0):
    return tuple(p + s * q for p, q in zip(a, b))


def scale(a, s):
    return tuple(s * p for p in a)


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scale(a, 1.0 / math.sqrt(dot(a, a)))


def rotation(side, out, down):
    """The quaternion that turns x to `side`, y to `out`, z to `down` (a right-handed frame)."""
    m = [[side[i], out[i], down[i]] for i in range(3)]
    w = math.sqrt(max(0.0, 1.0 + m[0][0] + m[1][1] + m[2][2])) / 2.0
    x = math.sqrt(max(0.0, 1.0 + m[0][0] - m[1][1] - m[2][2])) / 2.0
    y = math.sqrt(max(0.0, 1.0 - m[0][0] + m[1][1] - m[2][2])) / 2.0
    z = math.sqrt(max(0.0, 1.0 - m[0][0] - m[1][1] + m[2][2])) / 2.0
    x = math.copysign(x, m[2][1] - m[1][2])
    y = math.copysign(y, m[0][2] - m[2][0])
    z = math.copysign(z, m[1][0] - m[0][1])
    return (w, x, y, z)


def about(axis, degrees, v):
    """`v` turned about the unit `axis`."""
    a = math.radians(degrees)
    return add(add(scale(v, math.cos(a)), cross(axis, v), math.sin(a)), axis,
               dot(axis, v) * (1.0 - math.cos(a)))


# ---- strokes -------------------------------------------------------------------------------------
def stroke(tool, size, points, symmetry="x", spacing=0.25, strength=1.0, turn=PLAIN, pressure=None):
    """`size` one radius or three, `points` places, `pressure` one number for each place."""
    line = {"tool": tool}
    if isinstance(size, tuple):
        line["shape"], line["radii_mm"] = "ellipsoid", list(size)
    else:
        line["shape"], line["radius_mm"] = "ball", size
    if strength != 1.0:
        line["strength"] = strength
    line["symmetry"] = symmetry
    if len(points) > 1:
        line["spacing"] = spacing
    poses = []
    for i, point in enumerate(points):
        pose = [round(0.02 * i, 3)] + [round(c, 3) for c in point]
        press = 1.0 if pressure is None else pressure[i]
        if turn != PLAIN or press != 1.0:
            pose += [round(c, 5) for c in turn] + [round(press, 3)]
        poses.append(pose)
    line["poses"] = poses
    strokes.append(line)


def line_points(a, b, count):
    return [add(scale(a, 1.0 - i / (count - 1)), b, i / (count - 1)) for i in range(count)]


class Egg:
    """An ellipsoid form with its own axes: where plumage sits."""

    def __init__(self, center, radii, turns=()):
        self.center, self.radii = center, radii
        self.axes = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
        for axis, degrees in turns:
            self.axes = [about(axis, degrees, a) for a in self.axes]

    def world(self, local):
        p = self.center
        for axis, c in zip(self.axes, local):
            p = add(p, axis, c)
        return p

    def add(self, symmetry=""):
        stroke("add", tuple(float(r) for r in self.radii), [self.center], symmetry,
               turn=rotation(*self.axes) if self.axes[0] != (1.0, 0.0, 0.0) else PLAIN)

    def at(self, direction):
        """Surface point and outward normal along a local direction from the centre."""
        q = [d / r for d, r in zip(direction, self.radii)]
        s = 1.0 / math.sqrt(dot(q, q))
        local = scale(direction, s)
        grad = tuple(c / (r * r) for c, r in zip(local, self.radii))
        normal = (0.0, 0.0, 0.0)
        for axis, g in zip(self.axes, grad):
            normal = add(normal, axis, g)
        return self.world(local), unit(normal)

    def around(self, degrees, height):
        """At a height of the egg (-1 to 1), `degrees` from the front (-y) toward +x."""
        a = math.radians(degrees)
        r = math.sqrt(max(0.0, 1.0 - height * height))
        return self.at((math.sin(a) * r * self.radii[0], -math.cos(a) * r * self.radii[1],
                        height * self.radii[2]))


def mark(place, out, along, half_length, width, symmetry="x"):
    """A fine tapered line drawn with one touch of a long, thin tool."""
    side = unit(cross(out, along))
    along = unit(cross(side, out))
    stroke("carve", (width, 1.1 * width, min(half_length, 19.0 * width)), [place], symmetry,
           turn=rotation(side, out, along))


def feather(place, out, down, size, lift_degrees=11.0, rise=0.25, quill=0.0, symmetry="x"):
    """One feather: a flat ellipsoid along `down`, its tip lifted off the one below."""
    side = unit(cross(out, down))
    down = unit(cross(side, out))
    lift = math.radians(lift_degrees)
    tilted = add(scale(down, math.cos(lift)), out, math.sin(lift))
    face = unit(cross(tilted, side))
    middle = add(place, out, rise)
    stroke("add", size, [middle], symmetry, turn=rotation(side, face, tilted))
    if quill > 0.0:  # the shaft
        top = add(add(middle, face, 0.96 * size[1]), tilted, 0.22 * size[2])
        mark(top, face, tilted, 0.62 * size[2], quill, symmetry)


def downward(out, lean=(0.0, 0.0, 0.0)):
    """Along the surface, down and toward `lean`."""
    want = add((0.0, 0.0, -1.0), lean)
    return unit(add(want, out, -dot(want, out)))


# ---- the piece -----------------------------------------------------------------------------------
BODY = Egg((0.0, 1.0, -6.0), (21.0, 19.0, 28.0))
NECK = Egg((0.0, -0.5, 13.0), (17.5, 16.0, 10.0))
HEAD = Egg((0.0, -2.0, 26.0), (20.0, 17.5, 16.5))
WING = Egg((18.5, 4.0, -6.0), (5.0, 13.0, 22.0), (((0.0, 0.0, 1.0), 12.0), ((1.0, 0.0, 0.0), 14.0),
                                                 ((0.0, 1.0, 0.0), 7.0)))
LEG = Egg((8.5, -8.5, -27.0), (6.0, 6.0, 7.5))
LOG_Z, LOG_R = -41.0, 8.5


def large_forms():
    BODY.add()
    HEAD.add()
    # A neck, then everything smoothed into one form.
    NECK.add()
    ring = [(19.5 * math.sin(a), -1.0 - 17.0 * math.cos(a), 14.5)
            for a in (math.pi * i / 12.0 for i in range(13))]
    stroke("smooth", 7.0, ring, "x", spacing=0.35)
    stroke("smooth", 7.0, ring, "x", spacing=0.35)
    WING.add("x")


def branch():
    log = [(x, 1.0 + 1.5 * math.sin(0.07 * x + 0.6), LOG_Z + 0.8 * math.sin(0.11 * x)) for x in
           range(-36, 37, 3)]
    stroke("add", LOG_R, log, "", spacing=0.12)
    stroke("add", 4.2, line_points((24.0, -5.0, LOG_Z + 3.0), (30.0, -13.5, LOG_Z + 7.0), 5), "",
           spacing=0.15, pressure=[1.0, 0.95, 0.9, 0.85, 0.8])
    cut = unit((6.0, -8.5, 4.0))  # where a twig was sawn off
    face = add((30.0, -13.5, LOG_Z + 7.0), cut, 4.2)
    flat = unit(cross(cut, (0.0, 0.0, 1.0)))
    stroke("carve", (6.5, 3.5, 6.5), [face], "", turn=rotation(flat, cut, cross(flat, cut)))
    for end in (-1.0, 1.0):  # sawn ends
        stroke("carve", (6.0, 16.0, 16.0), [(end * 42.5, 1.0, LOG_Z)], "")
    bark()
    growth_rings()


def log_axis(x):
    return 1.0 + 1.5 * math.sin(0.07 * x + 0.6), LOG_Z + 0.8 * math.sin(0.11 * x)


def bark():
    for i in range(30):
        angle = math.radians(12.0 * i)
        start = -36.0 + 17.0 * ((i * 0.618) % 1.0)
        for piece in range(2):
            points, press = [], []
            length = 26.0 + 12.0 * ((i * 0.382 + 0.5 * piece) % 1.0)
            for k in range(15):
                x = start + piece * 36.0 + length * k / 14.0
                if abs(x) > 36.0:
                    continue
                y, z = log_axis(x)
                a = angle + 0.10 * math.sin(0.33 * x + 1.7 * i) + 0.05 * math.sin(0.8 * x + i)
                points.append((x, y + (LOG_R + 0.1) * math.cos(a), z + (LOG_R + 0.1) * math.sin(a)))
                press.append(0.45 + 0.55 * math.sin(math.pi * (k + 0.5) / 15.0))
            if len(points) > 2:
                stroke("carve", 0.75, points, "", spacing=0.7, pressure=press)


def growth_rings():
    for end in (-1.0, 1.0):
        y, z = log_axis(end * 36.5)
        for radius in (1.6, 3.2, 4.7, 6.1, 7.3):
            points = []
            for i in range(33):
                a = 2.0 * math.pi * i / 32.0
                r = radius * (1.0 + 0.05 * math.sin(2.0 * a + radius))
                px, pz = y + r * math.cos(a), z + r * math.sin(a)
                # on the hollow that the saw left: an ellipsoid of half axes 6 and 16
                q = ((px - 1.0) ** 2 + (pz - LOG_Z) ** 2) / 256.0
                points.append((end * (42.5 - 6.0 * math.sqrt(max(0.0, 1.0 - q))), px, pz))
            stroke("carve", 0.45, points, "", spacing=0.5)


def feet():
    LEG.add("x")
    for row in range(7):
        height = -0.80 + 0.22 * row
        for k in range(9):
            place, out = LEG.around(-88.0 + 22.0 * (k + 0.5 * (row % 2)), height)
            feather(place, out, downward(out), (1.5, 0.7, 2.9), 10.0, 0.1, 0.28)
    for spread in (-3.6, 0.0, 3.6):
        points, press = [], []
        for i in range(9):
            a = math.radians(22.0 + 9.5 * i)
            x = 8.5 + spread * min(1.0, 0.25 + i / 5.0)
            y, z = log_axis(x)
            r = LOG_R + 1.0
            points.append((x, y - r * math.sin(a), z + r * math.cos(a)))
            press.append(1.0 if i < 6 else 1.0 - 0.22 * (i - 5))
        stroke("add", 2.1, points, "x", spacing=0.15, pressure=press)
        for i in (2, 3, 4, 5):  # scales across the toe
            a = math.radians(22.0 + 9.5 * (i + 0.5))
            x = 8.5 + spread * min(1.0, 0.25 + (i + 0.5) / 5.0)
            y, z = log_axis(x)
            arc = []
            for k in range(-3, 4):
                b = math.radians(24.0 * k)
                r = LOG_R + 1.0 + 2.15 * math.cos(b)
                arc.append((x + 2.15 * math.sin(b), y - r * math.sin(a), z + r * math.cos(a)))
            stroke("carve", 0.4, arc, "x", spacing=0.5)


def tail():
    for i, x in enumerate((7.5, 4.0, 0.0)):
        down = unit((0.09 * x, 0.42, -1.0))
        out = unit(cross(down, cross((0.0, 1.0, 0.0), down)))
        out = out if out[1] > 0.0 else scale(out, -1.0)
        feather((x, 18.5 + 0.7 * i, -30.0), out, down, (3.3, 1.3, 15.0), 0.0, 0.0, 0.45)


# ---- the face ------------------------------------------------------------------------------------
def eye_frame():
    place, out = HEAD.at((math.sin(math.radians(25.0)), -math.cos(math.radians(25.0)), 0.16))
    up = unit(add((0.0, 0.0, 1.0), out, -out[2]))
    return place, out, unit(cross(up, out)), up


DISH = (9.6, 3.2, 10.2)  # half axes of the dish around an eye: across, deep, up
DISH_SINK = 1.2


def on_dish(u, v):
    """A place on the dish's floor, `u` across and `v` up from the eye."""
    place, out, side, up = eye_frame()
    q = 1.0 - (u / DISH[0]) ** 2 - (v / DISH[2]) ** 2
    depth = DISH_SINK + DISH[1] * math.sqrt(max(0.0, q))
    return add(add(add(place, side, u), up, v), out, -depth)


def facial_discs():
    place, out, side, up = eye_frame()
    stroke("carve", DISH, [add(place, out, -DISH_SINK)], "x", turn=rotation(side, scale(out, 1.0),
                                                                             cross(side, out)))
    for i in range(36):  # the disc's feathers: rays drawn from the eye
        a = 2.0 * math.pi * (i + 0.5) / 36.0
        inner, middle, outer = (on_dish(DISH[0] * t * math.cos(a), DISH[2] * t * math.sin(a))
                                for t in (0.66, 0.80, 0.94))
        ray = unit(add(outer, inner, -1.0))
        across = unit(cross(out, ray))
        mark(middle, unit(cross(ray, across)), ray, 2.1, 0.42)
    rim = []
    for i in range(49):
        a = 2.0 * math.pi * i / 48.0
        flat = add(add(place, side, 9.4 * math.cos(a)), up, 10.0 * math.sin(a))
        local = add(flat, HEAD.center, -1.0)
        rim.append(HEAD.at(local)[0])
    stroke("add", 1.25, rim, "x", spacing=0.2)


def eyes():
    place, out, side, up = eye_frame()
    center = add(place, out, -4.3)
    radius = 6.0
    stroke("add", radius, [center], "x")

    def on_eye(angle, turn, r=radius):
        a, b = math.radians(angle), math.radians(turn)
        tangent = add(scale(side, math.cos(b)), up, math.sin(b))
        return add(center, add(scale(out, math.cos(a)), tangent, math.sin(a)), r)

    stroke("carve", 0.5, [on_eye(44.0, 10.0 * i) for i in range(37)], "x", spacing=0.3)
    for i in range(24):  # the iris
        inner, middle, outer = (on_eye(t, 15.0 * i) for t in (29.0, 34.5, 40.0))
        mark(middle, unit(add(middle, center, -1.0)), unit(add(outer, inner, -1.0)), 0.85, 0.28)
    stroke("carve", 2.7, [add(center, out, radius - 0.2)], "x")
    stroke("carve", 1.9, [add(center, out, radius - 2.4)], "x")
    glint = add(add(add(center, out, radius - 1.0), up, 1.6), side, -1.3)
    stroke("add", 0.95, [glint], "x")
    lid = [on_eye(58.0, t, radius + 0.1) for t in range(25, 160, 9)]
    stroke("add", 1.0, lid, "x", spacing=0.2,
           pressure=[0.35 + 0.65 * math.sin(math.pi * (i + 0.5) / len(lid)) for i in
                     range(len(lid))])


def on_head(degrees, height, sink=0.0):
    place, out = HEAD.around(degrees, height)
    return add(place, out, -sink)


def brows_and_tufts():
    root, top = on_head(47.0, 0.78, 3.0), (17.4, -2.0, 53.0)
    middle = (14.6, -5.0, 45.6)
    stroke("add", 4.6, [root, middle, top], "x", spacing=0.1, pressure=[1.0, 0.80, 0.12])
    along = unit(add(top, root, -1.0))
    side = unit(cross(along, (0.0, 0.0, 1.0)))
    front = cross(side, along)
    for row, (share, reach) in enumerate(((0.12, 4.1), (0.36, 3.4), (0.58, 2.4), (0.76, 1.3))):
        for k in range(8):  # slim feathers up the tuft
            a = 2.0 * math.pi * (k + 0.5 * (row % 2)) / 8.0
            around = add(scale(side, math.cos(a)), front, math.sin(a))
            if share < 0.5:
                at = add(scale(root, 1.0 - 2.0 * share), middle, 2.0 * share)
            else:
                at = add(scale(middle, 2.0 - 2.0 * share), top, 2.0 * share - 1.0)
            feather(add(at, around, reach), around, along,
                    (1.35 - 0.2 * row, 0.5, 4.6 - 0.3 * row), -7.0, -0.1, 0.27)
    # The brow: a ridge from the beak over the eye to the tuft, of hair-like feathers.
    brow = [(3.0, 0.12), (11.0, 0.36), (20.0, 0.55), (31.0, 0.69), (43.0, 0.80)]
    stroke("add", 2.2, [on_head(d, h, 0.2) for d, h in brow], "x", spacing=0.12,
           pressure=[0.55, 0.85, 1.0, 1.0, 1.0])
    for i in range(13):
        t = i / 12.0 * (len(brow) - 1)
        k = min(int(t), len(brow) - 2)
        d, h = (p + (t - k) * (q - p) for p, q in zip(brow[k], brow[k + 1]))
        place, out = HEAD.around(d, h)
        ahead = unit(add(on_head(d + 6.0, h + 0.14), place, -1.0))
        for shift in (-0.9, 0.9):
            sideways = unit(cross(out, ahead))
            feather(add(add(place, out, 1.5), sideways, shift), out, ahead, (0.95, 0.6, 3.1), 7.0,
                    0.1, 0.28)


def beak():
    bridge = [(0.0, -19.6, 29.5), (0.0, -21.8, 27.0), (0.0, -23.0, 24.4), (0.0, -23.0, 22.0),
              (0.0, -21.9, 19.8)]
    stroke("add", 2.6, bridge, "", spacing=0.1, pressure=[0.85, 1.0, 0.92, 0.66, 0.22])
    mark((2.1, -22.6, 24.3), unit((0.9, -0.4, 0.0)), unit((-0.25, -0.5, -1.0)), 2.6, 0.32)
    stroke("carve", 0.55, [(1.35, -23.9, 26.7)], "x")
    for i in range(4):  # bristles beside it
        place, out = HEAD.around(9.0 + 2.5 * i, 0.10 - 0.10 * i)
        feather(add(place, out, 0.6), out, unit((0.55, 0.0, -1.0)), (0.85, 0.6, 3.0), 10.0, 0.1,
                0.25)


# ---- plumage -------------------------------------------------------------------------------------
def belly():
    heights = [-0.93 + 0.118 * i for i in range(15)]
    for row, height in enumerate(heights):
        around = math.sqrt(1.0 - height * height) * 20.0
        step = 4.3 / around * 57.3
        first = 0.5 * step if row % 2 else 0.0
        angle = first
        while angle < 66.0:
            place, out = BODY.around(angle, height)
            feather(place, out, downward(out), (2.5, 0.95, 3.9), 13.0, 0.15, 0.32,
                    "x" if angle > 0.0 else "")
            angle += step


def back():
    for row in range(13):
        height = -0.86 + 0.13 * row
        around = math.sqrt(1.0 - height * height) * 20.0
        step = 5.6 / around * 57.3
        angle = 180.0 - (0.5 * step if row % 2 else 0.0)
        while angle > 118.0:
            place, out = BODY.around(angle, height)
            feather(place, out, downward(out), (3.3, 1.0, 4.8), 11.0, 0.15, 0.36,
                    "x" if angle < 180.0 else "")
            angle -= step


def crown():
    for row in range(15):
        height = -0.62 + 0.108 * row
        around = math.sqrt(max(0.03, 1.0 - height * height)) * 19.0
        step = 3.5 / around * 57.3
        angle = 180.0 - (0.5 * step if row % 2 else 0.0)
        least = 60.0 if height < 0.45 else (46.0 if height < 0.66 else 0.0)
        while angle > least:
            place, out = HEAD.around(angle, height)
            feather(place, out, downward(out, (0.0, 0.35, 0.0)), (2.1, 0.7, 3.0), 11.0, 0.1, 0.3,
                    "x" if 1.0 < angle < 180.0 else "")
            angle -= step


def collar():
    """Short feathers around the neck, over the topmost of the body."""
    for row in range(4):
        height = -0.62 + 0.30 * row
        for k in range(15):
            angle = 180.0 / 14.0 * (k + 0.5 * (row % 2))
            if angle > 181.0:
                continue
            place, out = NECK.around(angle, height)
            feather(add(place, out, 0.3), out, downward(out), (2.5, 0.95, 3.9), 10.0, 0.1, 0.32,
                    "x" if 1.0 < angle < 179.0 else "")


def wing_place(back_mm, up_mm):
    """On the wing's outer face."""
    x, y, z = WING.radii
    q = max(0.02, 1.0 - (back_mm / y) ** 2 - (up_mm / z) ** 2)
    return WING.at((x * math.sqrt(q), back_mm, up_mm))


def wings():
    # Rows from the tip up: long flight feathers first, small coverts last.
    rows = [(-15.0, (2.6, 1.0, 9.0), 5, 0.45), (-8.5, (2.5, 1.0, 8.5), 6, 0.45),
            (-2.0, (2.4, 1.0, 7.0), 7, 0.4), (3.5, (2.3, 0.95, 5.4), 7, 0.36),
            (8.0, (2.2, 0.9, 4.2), 7, 0.34), (11.8, (2.0, 0.85, 3.4), 6, 0.3),
            (15.0, (1.9, 0.8, 3.0), 5, 0.3), (17.8, (1.7, 0.75, 2.6), 4, 0.3)]
    for row, (up_mm, size, count, quill) in enumerate(rows):
        reach = WING.radii[1] * math.sqrt(max(0.05, 1.0 - (up_mm / WING.radii[2]) ** 2)) * 0.97
        for k in range(count):
            share = (k + (0.5 if row % 2 else 0.1)) / (count - 0.4)
            back_mm = reach * (2.0 * share - 1.0)
            place, out = wing_place(back_mm, up_mm)
            feather(place, out, downward(out, (0.0, 0.30, 0.0)), size, 9.0, 0.2, quill)


def script():
    large_forms()
    tail()
    branch()
    feet()
    belly()
    back()
    wings()
    collar()
    crown()
    facial_discs()
    eyes()
    brows_and_tufts()
    beak()
    start = {"shape": "ball", "radius_mm": 18.0, "voxel_mm": 0.2, "tolerance_voxels": 0.1}
    yield {"argil_strokes": 1, "units": "mm", "start": start}
    yield from strokes


for each in script():
    print(json.dumps(each, separators=(",", ":")))
