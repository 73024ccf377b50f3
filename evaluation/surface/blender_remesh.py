# SPDX-License-Identifier: GPL-3.0-or-later
"""What `argil chart surface` has Blender do: its voxel remesher on a given mesh, timed.

Usage: blender -b --factory-startup --python SCRIPT.py -- JOB.json

JOB.json  positions   file of float x, y, z of the vertices
          triangles   file of int, three corners a face
          voxel_mm    of the remesher, whose other settings are Blender's own
          runs        how often it is timed at most, each on the mesh as it was given
          result      files RESULT.positions and RESULT.triangles get what it makes
          answer      file for one line of JSON: "runs", [wall, CPU] in ms, or "error"
What it does not define is in blender/mesh.py, which comes before it.
"""
import array
import json
import os
import sys
import time

import bpy


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
        made = made_object(positions, corners, 3)
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
