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


def run_job(job):
    positions = read_array("f", job["positions"])
    corners = read_array("i", job["triangles"])
    runs = []
    begin = time.perf_counter()
    while len(runs) < job["runs"] and (not runs or time.perf_counter() - begin < ENOUGH_S):
        made = made_object(positions, corners, 3)
        runs.append(remeshed(made.data, job["voxel_mm"]))
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
