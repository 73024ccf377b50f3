# SPDX-License-Identifier: GPL-3.0-or-later
"""What `argil chart gallery` has Blender do: strokes of its sculpting brushes, and Booleans, on bodies
that its own voxel remesher made of given surfaces.

Usage: blender --factory-startup --python SCRIPT.py -- JOB.json

JOB.json  voxel_mm    of the remesher, whose other settings are Blender's own
          bodies      by name: files BODY.positions and BODY.triangles of the surface
          cases       what to do: see run_case
          answers     file that a line of JSON is added to for each case, after one with the version
What it does not define is in blender/mesh.py and blender/brush.py, which come before it.
"""
import array

import bmesh
import bpy
from mathutils import Vector


# A strength counts as found when the stroke moves the surface by so much of what is asked for.
CLOSE = 0.01
# Halvings of the range of strengths.
HALVINGS = 9
# Of the ball that a Boolean adds or takes away: an edge is 1/30 of the radius.
SEGMENTS = 192


class Body:
    """A remeshed surface, kept as what a fresh mesh is made of."""

    def __init__(self, name, voxel_mm):
        made = made_object(read_array("f", name + ".positions"), read_array("i", name + ".triangles"), 3)
        remeshed(made.data, voxel_mm)
        mesh = made.data
        self.positions = positions_of_active()
        self.normals = array.array("f", [0.0]) * len(self.positions)
        mesh.vertices.foreach_get("normal", self.normals)
        self.quads = array.array("i", [0]) * len(mesh.loops)
        mesh.loops.foreach_get("vertex_index", self.quads)
        if len(self.quads) != 4 * len(mesh.polygons):
            raise RuntimeError("the voxel remesher made other faces than quads")
        write_mesh(mesh, name + ".start")

    def fresh(self):
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        made = made_object(self.positions, self.quads, 4)
        # With a layer for a mask: the brush that makes one while it strokes ends Blender.
        layered = bmesh.new()
        layered.from_mesh(made.data)
        layered.verts.layers.paint_mask.verify()
        layered.to_mesh(made.data)
        layered.free()
        return made

    def moved_mm(self):
        """How far along its normal the vertex went that went farthest."""
        after = positions_of_active()
        farthest = 0.0
        for i in range(0, len(after), 3):
            along = sum((after[i + k] - self.positions[i + k]) * self.normals[i + k] for k in range(3))
            farthest = max(farthest, abs(along))
        return farthest


def make_strokes(case, strength, body, region, view):
    """All strokes on a fresh body; the last has this strength, where it is given one."""
    body.fresh()
    bpy.ops.object.mode_set(mode="SCULPT")
    for stroke in case["strokes"]:
        is_last = stroke is case["strokes"][-1]
        brush = used_brush(stroke["brush"], stroke["radius_mm"], strength if is_last else stroke["strength"])
        for name, value in stroke["settings"].items():
            setattr(brush, name, value)
        elements = stroke_through(stroke["points"], Vector(stroke["toward"]), stroke["radius_mm"], region, view)
        ended = bpy.ops.sculpt.brush_stroke("EXEC_DEFAULT", True, stroke=elements)
        if ended != {"FINISHED"}:
            raise RuntimeError("the brush's operator answered " + str(ended))


def found_strength(case, body, region, view):
    """The strength whose stroke moves the surface by `aim_mm`, or 1 where none moves it so far."""
    low, high = 0.0, 1.0
    strength = high
    for _ in range(HALVINGS):
        make_strokes(case, strength, body, region, view)
        moved = body.moved_mm()
        if abs(moved - case["aim_mm"]) <= CLOSE * case["aim_mm"]:
            break
        if moved < case["aim_mm"]:
            if strength == high == 1.0:
                break
            low = strength
        else:
            high = strength
        strength = 0.5 * (low + high)
    return strength


def make_boolean(case, body, voxel_mm):
    """A ball united with the body, or taken from it, exactly; then remeshed."""
    made = body.fresh()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=SEGMENTS, ring_count=SEGMENTS // 2, radius=case["radius_mm"],
                                         location=case["at"])
    tool = bpy.context.active_object
    bpy.context.view_layer.objects.active = made
    modifier = made.modifiers.new("stamp", "BOOLEAN")
    modifier.object = tool
    modifier.operation = case["operation"]
    modifier.solver = "EXACT"
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    remeshed(made.data, voxel_mm)


def run_case(case, body, voxel_mm, region, view):
    """One action on a body as it was.

    number      of the answer
    body        its name
    operation   UNION or DIFFERENCE with a ball of `radius_mm` at `at`; else strokes
    strokes     one after the other: brush, radius_mm, strength, settings of the brush by their names,
                points of the dabs, and the direction `toward` the viewer
    aim_mm      how far the last stroke is to move the surface: its strength is sought; 0: as given
    result      files RESULT.positions and RESULT.triangles get the mesh
    """
    answer = {}
    if "operation" in case:
        make_boolean(case, body, voxel_mm)
    else:
        strength = case["strokes"][-1]["strength"]
        if case["aim_mm"] > 0.0:
            strength = found_strength(case, body, region, view)
        make_strokes(case, strength, body, region, view)
        answer["strength"] = strength
        bpy.ops.object.mode_set(mode="OBJECT")
    write_mesh(bpy.context.active_object.data, case["result"])
    return answer


def run_job(job):
    window, area, region = view_3d()
    view = area.spaces[0].region_3d
    add_line(job, {"version": bpy.app.version_string})
    with bpy.context.temp_override(window=window, area=area, region=region):
        bodies = {name: Body(file, job["voxel_mm"]) for name, file in job["bodies"].items()}
        for case in job["cases"]:
            answer = {"case": case["number"]}
            try:
                answer.update(run_case(case, bodies[case["body"]], job["voxel_mm"], region, view))
            except Exception as error:  # the other cases are still worth their time
                answer["error"] = str(error)
            add_line(job, answer)


run_in_window(run_job)
