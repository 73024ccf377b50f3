# SPDX-License-Identifier: GPL-3.0-or-later
"""What `argil chart edits` has Blender do: strokes of its sculpting brushes on a given mesh, timed.

Usage: blender --factory-startup --python SCRIPT.py -- JOB.json

The brush operator wants a window with a 3D view, so this runs in one (under Xvfb), from a timer
that fires when the window is there. All of it happens within one call of that timer, and Blender
draws only between calls: no redraw is in any of the times, nor are vertex normals and buffers of
the graphics card, which Blender brings up to date when it draws.

JOB.json  positions   file of float x, y, z of the vertices
          quads       file of int, four corners a face
          answers     file that a line of JSON is added to for each case
          cases       what to do: see run_case
What it does not define is in blender/mesh.py and blender/brush.py, which come before it.
"""
import array
import time

import bpy
from mathutils import Vector


def set_brush(case):
    """Chosen again before each stroke: undoing one brings back the brush of before."""
    brush = used_brush(case["brush"], case["radius_mm"], case["strength"])
    if case["brush"] == "SculptDraw":
        brush.direction = "ADD"


def stroke_of(case, dabs, region, view):
    """Seen from straight above the first dab; grab alone goes by the mouse."""
    points = case["points"][:dabs]
    return stroke_through(points, Vector(points[0]), case["radius_mm"], region, view)


def timed_stroke(case, dabs, region, view):
    """Wall and CPU time in ms, the record for undo included; CPU is that of all threads."""
    set_brush(case)
    stroke = stroke_of(case, dabs, region, view)
    cpu = time.process_time()
    wall = time.perf_counter()
    ended = bpy.ops.sculpt.brush_stroke("EXEC_DEFAULT", True, stroke=stroke)
    times = [1e3 * (time.perf_counter() - wall), 1e3 * (time.process_time() - cpu)]
    if ended != {"FINISHED"}:
        raise RuntimeError("the brush's operator answered " + str(ended))
    return times


def write_kept(case):
    """Where the vertices that `keep` numbers are now, of a mesh whose faces the caller knows."""
    positions = positions_of_active()
    with open(case["result"] + ".positions", "wb") as file:
        array.array("f", [positions[3 * i + k] for i in read_array("i", case["keep"])
                          for k in range(3)]).tofile(file)


def begin_sculpting(case):
    if bpy.context.mode != "SCULPT":
        bpy.ops.object.mode_set(mode="SCULPT")
    if case["mode"] != "dyntopo":
        return
    settings = bpy.context.tool_settings.sculpt
    settings.detail_type_method = "CONSTANT"
    settings.detail_refine_method = "SUBDIVIDE_COLLAPSE"
    settings.constant_detail_resolution = 1.0 / case["detail_mm"]
    bpy.ops.sculpt.dynamic_topology_toggle()


def run_case(case, region, view):
    """One brush, on a mesh that is as it was made; plain leaves it so.

    number    of the answer
    brush     Blender's name of it
    mode      plain; dyntopo: dynamic topology, edges up to detail_mm; remesh: plain, and after the
              stroke the whole mesh by the voxel remesher (voxels of detail_mm)
    points    of the dabs of the long stroke; the short one has the first `short`
    repeats   how often both are timed at most, each undone before the next
    keep      file of vertex numbers, for plain; result: where their positions go, or the new mesh
    """
    dabs = len(case["points"])
    answer = {"short": [], "long": [], "once": []}
    begin = time.perf_counter()
    for run in range(case["repeats"]):
        if run > 0 and time.perf_counter() - begin > ENOUGH_S:
            break
        for name, length in (("short", case["short"]), ("long", dabs)):
            answer[name].append(timed_stroke(case, length, region, view))
            bpy.ops.ed.undo()
    timed_stroke(case, dabs, region, view)
    if case["mode"] == "plain":
        write_kept(case)
        bpy.ops.ed.undo()
        return answer
    if case["mode"] == "remesh":
        answer["once"].append(remeshed(bpy.context.active_object.data, case["detail_mm"]))
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")  # dynamic topology has its own mesh until then
    write_mesh(bpy.context.active_object.data, case["result"])
    return answer


def stroke_to_stay(case, region, view):
    """A dab on the far side, which stays: the undo of a first stroke would read a whole file."""
    far = dict(case, points=[[-x for x in case["points"][0]]])
    timed_stroke(far, 1, region, view)


def run_job(job):
    """Cases of plain sculpting share a mesh; each other has its own."""
    positions = read_array("f", job["positions"])
    quads = read_array("i", job["quads"])
    window, area, region = view_3d()
    view = area.spaces[0].region_3d
    is_fresh = False
    with bpy.context.temp_override(window=window, area=area, region=region):
        for case in job["cases"]:
            answer = {"case": case["number"]}
            try:
                if not is_fresh or case["mode"] != "plain":
                    made_object(positions, quads, 4)
                    begin_sculpting(case)
                    stroke_to_stay(case, region, view)
                answer.update(run_case(case, region, view))
                is_fresh = case["mode"] == "plain"
            except Exception as error:  # the other cases are still worth their time
                answer["error"] = str(error)
                is_fresh = False
            add_line(job, answer)


run_in_window(run_job)
