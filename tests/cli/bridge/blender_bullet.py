# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether Bullet gives the proxy the spring that the hand is told of, measured by what it moves.

Usage: blender -b --factory-startup --python-exit-code 3 --python blender_bullet.py -- CASE...
"""
import os
import sys

import bpy
from mathutils import Vector

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_bridge as bridge  # noqa: E402
import argil_scene  # noqa: E402

IS_THOROUGH = bool(os.environ.get("ARGIL_THOROUGH"))
START = (-0.2, 0.0, 0.3)
GRAVITY = Vector((0.0, 0.0, -9.81))


class World:
    """The scene of cubes and a hand in it; places are the scene's."""

    def __init__(self, stiffness=1500.0, scale=10.0):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.welcome = bridge.Welcome(stiffness_n_per_m=stiffness, scale=scale)
        argil_scene.start_world()
        self.contact = argil_scene.DynamicContact(
            self.welcome, argil_scene.add_floor(), argil_scene.add_cubes(), START)

    def hold(self, place, frames=180):
        """Where the proxy is from the hand after so many frames, and the last answer."""
        state = bridge.State(position_mm=bridge.to_device(place, self.welcome.scale))
        for _ in range(frames):
            answer = self.contact.answer(state, self.welcome)
        return Vector(bridge.to_scene(answer.position_mm, self.welcome.scale)) - Vector(place), answer


def stiffness():
    """An acceleration that the proxy does not know of stretches the spring by m a / k."""
    springs = [(300.0, 3.0)]
    if IS_THOROUGH:
        springs += [(1500.0, 10.0), (1500.0, 1.0), (5900.0, 10.0)]
    for k, scale in springs:
        world = World(k, scale)
        spring, mass = k / scale, world.contact.proxy.rigid_body.mass
        weight, _ = world.hold(START)
        assert weight.length < 0.01 * mass * 9.81 / spring, (k, scale, weight)
        more = Vector((3.0, -2.0, -4.0))
        bpy.context.scene.gravity = GRAVITY + more
        stretch, _ = world.hold(START)
        off = stretch - mass * more / spring
        assert off.length < 0.02 * mass * more.length / spring, (k, scale, stretch)


def no_offset():
    """A hand that is elsewhere at the first frame has its proxy there."""
    world = World()
    away, _ = world.hold((-0.3, 0.1, 0.2))
    assert away.length < 1e-4, away


def hovering():
    """Half a millimetre over the floor nothing touches; on it, the plane looks up."""
    world = World()
    radius = argil_scene.PROXY_RADIUS_M
    steps = 120 if IS_THOROUGH else 60
    for step in range(steps):
        away, answer = world.hold((-0.2 - 0.6 * step / steps, 0.0, radius + 0.0005), 1 if step else 60)
        assert not answer.flags & bridge.CONTACT, (step, answer)
    for height in (-0.02, -0.001):
        _, answer = world.hold((-0.5, 0.0, radius + height), 60)
        assert answer.flags & bridge.CONTACT and answer.flags & bridge.PLANE, answer
        assert answer.plane_normal[1] > 0.999, answer
        assert abs(answer.direct_force_n[1] + height * 150.0) < 0.01, answer
        assert abs(answer.plane_point_mm[1] - 100.0 * radius) < 0.01, answer


def tunnelling():
    """A hand of 0.6 m/s goes into the cubes at one substep a frame, and pushes all at ten."""
    deepest = {}
    for substeps in (1, argil_scene.SUBSTEPS):
        world = World()
        bpy.context.scene.rigidbody_world.substeps_per_frame = substeps
        at = Vector((-0.2, 0.065, 0.06))
        world.hold(at, 60)
        gaps = []
        for _ in range(30):
            at.x += 6.0 / argil_scene.STEPS_PER_S
            gaps.append(world.hold(at, 1)[1].distance_mm)
        deepest[substeps] = min(gaps)
    assert deepest[1] < -2.0, deepest
    assert deepest[argil_scene.SUBSTEPS] > -0.2, deepest
    row = world.contact.bodies[6:]
    graph = bpy.context.evaluated_depsgraph_get()
    for cube in row:
        moved = cube.evaluated_get(graph).matrix_world.translation - cube.location
        assert moved.length > argil_scene.CUBE_M, (cube.name, moved)


CASES = {case.__name__: case for case in (stiffness, no_offset, hovering, tunnelling)}
for name in sys.argv[sys.argv.index("--") + 1:]:
    CASES[name]()
