# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts for Blender share: the program puts this before each of them.

Debian's Blender comes without numpy, so arrays are those of the standard library.
"""
import array
import time

import bpy


# What takes so long is timed once: it is not by chance.
ENOUGH_S = 2.0


def read_array(kind, path):
    values = array.array(kind)
    with open(path, "rb") as file:
        values.frombytes(file.read())
    return values


def added_object(name, positions, corners, of_face):
    """A mesh with so many corners a face as one more object."""
    mesh = bpy.data.meshes.new(name)
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
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def made_object(positions, corners, of_face):
    """The same as the only object, active and selected."""
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    for old in list(bpy.data.meshes):
        bpy.data.meshes.remove(old)
    made = added_object("body", positions, corners, of_face)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    bpy.context.view_layer.update()
    return made


def remeshed(mesh, voxel_mm):
    """The active object's mesh by the voxel remesher, with its own settings but for the voxel.

    Times in ms of the operator alone: wall, and CPU of all threads.
    """
    mesh.remesh_voxel_size = voxel_mm
    mesh.remesh_voxel_adaptivity = 0.0
    cpu = time.process_time()
    wall = time.perf_counter()
    ended = bpy.ops.object.voxel_remesh()
    if ended != {"FINISHED"}:
        raise RuntimeError("the voxel remesher answered " + str(ended))
    return [1e3 * (time.perf_counter() - wall), 1e3 * (time.process_time() - cpu)]


def write_mesh(mesh, result):
    """As triangles, two of each quad."""
    positions = array.array("f", [0.0]) * (3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", positions)
    mesh.calc_loop_triangles()
    corners = array.array("i", [0]) * (3 * len(mesh.loop_triangles))
    mesh.loop_triangles.foreach_get("vertices", corners)
    for ending, values in ((".positions", positions), (".triangles", corners)):
        with open(result + ending, "wb") as file:
            values.tofile(file)


