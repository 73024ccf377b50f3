# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts for Blender share: the program puts this before each of them.

Debian's Blender comes without numpy, so arrays are those of the standard library.
"""
import array

import bpy


# What takes so long is timed once: it is not by chance.
ENOUGH_S = 2.0


def read_array(kind, path):
    values = array.array(kind)
    with open(path, "rb") as file:
        values.frombytes(file.read())
    return values


def made_object(positions, corners, of_face):
    """A mesh with so many corners a face as the only object, active and selected."""
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    for old in list(bpy.data.meshes):
        bpy.data.meshes.remove(old)
    mesh = bpy.data.meshes.new("body")
    faces = len(corners) // of_face
    mesh.vertices.add(len(positions) // 3)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(faces)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, of_face * faces, of_face)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [of_face]) * faces)
    mesh.update(calc_edges=True)
    mesh.use_mirror_x = mesh.use_mirror_y = mesh.use_mirror_z = False
    made = bpy.data.objects.new("body", mesh)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    bpy.context.view_layer.update()
    return made


