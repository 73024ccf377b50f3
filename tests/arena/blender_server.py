# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshes one mesh after another, since starting Blender takes longer than that.

Usage: blender -b --factory-startup --python SCRIPT.py -- FOLDER

What it waits for are files FOLDER/NUMBER.job, from 0 on: JSON with "body" and "result", files as in
evaluation/blender/made_mesh.py, and "voxel". It answers each by a file NUMBER.done: JSON with "ms",
wall and CPU, or "error". A file FOLDER/stop ends it, and so does that its parent is gone.
What it does not define is in evaluation/blender/mesh.py, which comes before it.
"""
import json
import os
import sys


def run_job(job):
    made = made_object(read_array("f", job["body"] + ".positions"),
                       read_array("i", job["body"] + ".triangles"), 3)
    took = remeshed(made.data, job["voxel"])
    write_mesh(made.data, job["result"])
    return {"ms": took}


def serve(folder):
    number = 0
    parent = os.getppid()
    while os.getppid() == parent and not os.path.exists(folder + "/stop"):
        name = folder + "/" + str(number)
        if not os.path.exists(name + ".job"):
            time.sleep(0.002)
            continue
        with open(name + ".job", encoding="utf-8") as file:
            job = json.load(file)
        try:
            answer = run_job(job)
        except Exception as error:  # told in the table
            answer = {"error": str(error)}
        with open(name + ".part", "w", encoding="utf-8") as file:
            json.dump(answer, file)
        os.rename(name + ".part", name + ".done")
        number += 1


serve(sys.argv[sys.argv.index("--") + 1])
sys.stdout.flush()
os._exit(0)  # its settings are nobody's
