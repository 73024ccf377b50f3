# SPDX-License-Identifier: GPL-3.0-or-later
"""What `argil chart surface` has Blender do: its voxel remesher on a given mesh, timed.

Usage: blender -b --factory-startup --python blender_remesh.py -- JOB.json

JOB.json  positions   file of float x, y, z of the vertices
          triangles   file of int, three corners a face
          voxel_mm    of the remesher, whose other settings are Blender's own
          runs        how often it is timed at most, each on the mesh as it was given
          result      files RESULT.positions and RESULT.triangles get what it makes
          answer      file for one line of JSON: "runs", [wall, CPU] in ms, or "error"
Debian's Blender comes without numpy, so arrays are those of the standard library.
"""
import array
import json
import os
import sys
import time

import bpy


# What takes so long is timed once: it is not by chance.
ENOUGH_S = 2.0


def read_array(kind, path):
    values = array.array(kind)
    with open(path, "rb") as file:
        values.frombytes(file.read())
    return values


def made_object(positions, corners):
    """The mesh as the only object, active and selected."""
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    for old in list(bpy.data.meshes):
        bpy.data.meshes.remove(old)
    mesh = bpy.data.meshes.new("body")
    faces = len(corners) // 3
    mesh.vertices.add(len(positions) // 3)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(faces)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, 3 * faces, 3)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [3]) * faces)
    mesh.update(calc_edges=True)
    made = bpy.data.objects.new("body", mesh)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    bpy.context.view_layer.update()
    return made


def remeshed(made, voxel_mm):
    """Times of the operator alone: wall, and CPU of all threads."""
    made.data.remesh_voxel_size = voxel_mm
    made.data.remesh_voxel_adaptivity = 0.0
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


def run_job(job):
    positions = read_array("f", job["positions"])
    corners = read_array("i", job["triangles"])
    runs = []
    begin = time.perf_counter()
    while len(runs) < job["runs"] and (not runs or time.perf_counter() - begin < ENOUGH_S):
        made = made_object(positions, corners)
        runs.append(remeshed(made, job["voxel_mm"]))
    write_mesh(made.data, job["result"])
    return {"runs": runs}


with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as job_file:
    the_job = json.load(job_file)
try:
    answer = run_job(the_job)
except Exception as error:  # told by name in the chart
    answer = {"error": str(error)}
with open(the_job["answer"], "w", encoding="utf-8") as answer_file:
    json.dump(answer, answer_file)
sys.stdout.flush()
os._exit(0)  # its settings are nobody's
