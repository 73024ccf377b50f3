# SPDX-License-Identifier: GPL-3.0-or-later
"""What the charts of surfaces and operations have Blender make of meshes, timed.

Usage: blender -b --factory-startup --python SCRIPT.py -- JOB.json

JOB.json  body, other  files NAME.positions of float x, y, z and NAME.triangles of int, three corners
                       a face; where there is no other, the voxel remesher makes the body anew
          voxel_mm     of the remesher, whose other settings are Blender's own
          runs         how often it is timed at most, each on the meshes as they were given
          result       files RESULT.positions and RESULT.triangles get what it makes
          answer       file for one line of JSON: "runs", [wall, CPU] in ms, or "error"
What it does not define is in blender/mesh.py, which comes before it.
"""
import array
import json
import os
import sys
import time

import bpy


def read_mesh(name):
    return read_array("f", name + ".positions"), read_array("i", name + ".triangles")


def with_other(body, other):
    """The body, active, with a modifier that has not been applied yet."""
    made = made_object(*body, 3)
    boolean = made.modifiers.new("union", "BOOLEAN")
    boolean.operation = "UNION"
    boolean.solver = "EXACT"
    boolean.object = added_object("other", *other, 3)
    return made


def united(made):
    """Times in ms of applying the modifier: wall, and CPU of all threads."""
    cpu = time.process_time()
    wall = time.perf_counter()
    ended = bpy.ops.object.modifier_apply(modifier="union")
    if ended != {"FINISHED"}:
        raise RuntimeError("the modifier answered " + str(ended))
    return [1e3 * (time.perf_counter() - wall), 1e3 * (time.process_time() - cpu)]


def run_job(job):
    body = read_mesh(job["body"])
    other = read_mesh(job["other"]) if "other" in job else None
    runs = []
    begin = time.perf_counter()
    while len(runs) < job["runs"] and (not runs or time.perf_counter() - begin < ENOUGH_S):
        made = with_other(body, other) if other else made_object(*body, 3)
        runs.append(united(made) if other else remeshed(made.data, job["voxel_mm"]))
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
