# SPDX-License-Identifier: GPL-3.0-or-later
"""What StaticContact makes of awkward meshes, by the force that the law `plane` gives for it.

Usage: blender -b --factory-startup --python-exit-code 3 --python blender_surface.py
"""
import math
import os
import random
import sys

import bmesh
import bpy
from mathutils import Vector

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_bridge as bridge  # noqa: E402
import argil_scene  # noqa: E402

SCALE = 10.0
WELCOME = bridge.Welcome(scale=SCALE)


def clear():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)


def depth_mm(contact, place):
    """How far the plane that is sent lies before the hand at this place of the scene."""
    state = bridge.State(position_mm=bridge.to_device(place, SCALE))
    proxy = bridge.decode(bridge.encode(contact.answer(state, WELCOME)))
    assert proxy is not None, "the bridge takes it"
    if not proxy.flags & bridge.PLANE:
        return 0.0
    way = bridge.add(proxy.plane_point_mm, bridge.scaled(state.position_mm, -1.0))
    return max(0.0, bridge.dot(proxy.plane_normal, way))


def contact_of_all():
    return argil_scene.StaticContact(argil_scene.felt_objects())


def expect_no_ghosts(name, is_inside):
    contact = contact_of_all()
    chance = random.Random(1)
    outside = 0
    for _ in range(3000):
        place = Vector([chance.uniform(-1.5, 1.5) for _ in range(3)])
        if not is_inside(place):
            outside += 1
            assert depth_mm(contact, place) < 1e-3, (name, place)
    assert outside > 1000, name


def add_mesh(vertices, polygons, is_turned_out=False):
    mesh = bpy.data.meshes.new("Mesh")
    mesh.from_pydata(vertices, [], polygons)
    if is_turned_out:
        work = bmesh.new()
        work.from_mesh(mesh)
        bmesh.ops.recalc_face_normals(work, faces=work.faces)
        work.to_mesh(mesh)
        work.free()
    obj = bpy.data.objects.new("Object", mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def sharp_edges_push_nobody_outside():
    clear()
    bpy.ops.mesh.primitive_cone_add(radius1=0.5, depth=1.0)
    expect_no_ghosts("cone", lambda p: abs(p.z) < 0.5 and math.hypot(p.x, p.y) < 0.5 * (0.5 - p.z))
    clear()
    half = math.tan(math.radians(10.0))
    add_mesh([(x, y, z) for x, z in ((0, 0), (-1, -half), (-1, half)) for y in (-0.5, 0.5)],
             [(0, 1, 5, 4), (1, 0, 2, 3), (2, 4, 5, 3), (0, 4, 2), (1, 3, 5)], is_turned_out=True)
    expect_no_ghosts("wedge", lambda p: -1 < p.x < 0 and abs(p.y) < 0.5 and abs(p.z) < -p.x * half)
    clear()
    bpy.ops.mesh.primitive_monkey_add(size=1.0)
    expect_no_ghosts("monkey", lambda p: p.length < 0.9)


def mirrors_keep_inside_and_outside():
    for scale in ((1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (-2.0, -0.5, -0.3)):
        clear()
        bpy.ops.mesh.primitive_cube_add(size=1.0)
        obj = bpy.context.object
        obj.scale = scale
        half = [0.5 * abs(s) for s in scale]
        bpy.context.view_layer.update()
        expect_no_ghosts(scale, lambda p: all(abs(a) < h for a, h in zip(p, half)))
        place = Vector((0.0, 0.0, half[2] - 0.02))
        assert abs(depth_mm(contact_of_all(), place) - 2.0) < 1e-3, scale


def open_meshes_are_felt_from_the_front():
    clear()
    bpy.ops.mesh.primitive_plane_add(size=1.0)

    def felt(*places):
        contact = contact_of_all()
        return [round(depth_mm(contact, Vector(place)), 3) for place in places]

    above, pressed = (0.0, 0.0, 0.1), (0.0, 0.0, -0.05)
    assert felt(above, pressed) == [0.0, 5.0]
    through = (0.0, 0.0, -0.11)
    assert felt(above, through, pressed, above, pressed) == [0.0, 0.0, 0.0, 0.0, 5.0]
    round_the_rim = (0.55, 0.0, 0.01), (0.55, 0.0, -0.01), (0.45, 0.0, -0.03)
    assert felt(*round_the_rim, pressed) == [0.0] * 4
    assert felt((0.55, 0.0, -0.05)) == [0.0], "beside it is not behind"
    # The rim of a cup, whose walls are open at the top alone.
    clear()
    bpy.ops.mesh.primitive_cylinder_add(radius=0.5, depth=1.0, end_fill_type="NOTHING")
    expect_no_ghosts("tube", lambda p: math.hypot(p.x, p.y) < 0.52)


def faces_without_area_are_left_out():
    clear()
    add_mesh([(0, 0, 0), (1, 0, 0), (0.5, 0, 0)], [(0, 1, 2)])
    assert contact_of_all().surface.tree is None
    floor = add_mesh([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)])
    assert round(depth_mm(contact_of_all(), Vector((0.5, 0.0, -0.01))), 3) == 1.0
    floor.scale.z = floor.scale.x = 0.0
    bpy.context.view_layer.update()
    assert contact_of_all().surface.tree is None


def what_shows_is_felt():
    clear()
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    cube = bpy.context.object
    inside = Vector((0.0, 0.0, 0.45))
    for hides in (lambda yes: cube.hide_set(yes), lambda yes: setattr(cube, "hide_viewport", yes)):
        assert round(depth_mm(contact_of_all(), inside), 3) == 5.0
        hides(True)
        assert contact_of_all().surface.tree is None
        hides(False)
    library = bpy.data.collections.new("Library")
    cube.users_collection[0].objects.unlink(cube)
    library.objects.link(cube)
    instance = bpy.data.objects.new("Instance", None)
    instance.instance_type, instance.instance_collection = "COLLECTION", library
    instance.location.x = 3.0
    bpy.context.scene.collection.objects.link(instance)
    bpy.context.view_layer.update()
    assert round(depth_mm(contact_of_all(), inside + Vector((3.0, 0.0, 0.0))), 3) == 5.0
    assert depth_mm(contact_of_all(), inside) == 0.0


sharp_edges_push_nobody_outside()
mirrors_keep_inside_and_outside()
open_meshes_are_felt_from_the_front()
faces_without_area_are_left_out()
what_shows_is_felt()
