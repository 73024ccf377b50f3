# SPDX-License-Identifier: GPL-3.0-or-later
"""Clay as live objects in Blender: what argil_clay.py received, as meshes.

One object holds the blocks of a cube of 128 finest nodes. Measured in Blender 3.4 on 660 000 triangles
in 4 780 blocks, a dab that changes 17 of them takes 11 ms so; 48 ms with an object for each block,
because Blender looks at every object; and 1.7 s with one object for all, which is rebuilt.
"""
import array

import bpy

import argil_clay

CUBE_BITS = 7
CLAY = "Argil clay"
TOOL = "Argil tool"


def _empty(name, shape):
    found = bpy.data.objects.get(name) or bpy.data.objects.new(name, None)
    found.empty_display_type = shape
    if name not in bpy.context.scene.objects:
        bpy.context.scene.collection.objects.link(found)
    return found


def _remove(obj):
    if obj is not None:
        mesh = obj.data
        bpy.data.objects.remove(obj)
        bpy.data.meshes.remove(mesh)


def _name_of(cube):
    return CLAY + " %d %d %d" % cube


def cube_of(name):
    """Where a block is kept: level L has nodes 2^L times as far apart as the finest."""
    level, *place = name
    return tuple((node << level) >> CUBE_BITS for node in place)


def fill(mesh, blocks):
    """Rebuilds the mesh of some blocks. Their normals are the clay's own, so that no seam shows where
    two objects meet."""
    positions, normals, triangles = array.array("f"), array.array("f"), array.array("i")
    for block in blocks:
        first = len(positions) // 3
        positions.extend(block.positions)
        normals.extend(block.normals)
        triangles.extend([first + n for n in block.triangles])
    count = len(triangles) // 3
    mesh.clear_geometry()
    mesh.vertices.add(len(positions) // 3)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", triangles)
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, 3 * count, 3)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [3]) * count)
    mesh.polygons.foreach_set("use_smooth", array.array("b", [1]) * count)
    if bpy.app.version < (4, 1, 0):
        mesh.use_auto_smooth = True  # or normals of one's own are not looked at
    mesh.update()
    each = iter(normals)
    mesh.normals_split_custom_set_from_vertices(list(zip(each, each, each)))


class ClayObjects:
    """The clay in Blender's metres, z up, below one empty, and the tool. For the main thread. Objects
    are found by their names: what a person's undo or delete took is made again when it changes."""

    def __init__(self):
        self.blocks = {}  # by cube, then by name
        root = _empty(CLAY, "PLAIN_AXES")
        root.scale = (0.001,) * 3
        for left in list(root.children):  # by an earlier coupling
            if left.type == "MESH":
                _remove(left)

    @property
    def tool(self):
        return _empty(TOOL, "SPHERE")

    @property
    def meshes(self):
        """Of the objects that there are."""
        found = map(bpy.data.objects.get, map(_name_of, self.blocks))
        return [obj.data for obj in found if obj is not None]

    def _mesh(self, cube):
        name = _name_of(cube)
        obj = bpy.data.objects.get(name)
        if obj is None:
            obj = bpy.data.objects.new(name, bpy.data.meshes.new(name))
            obj.parent = _empty(CLAY, "PLAIN_AXES")
            bpy.context.scene.collection.objects.link(obj)
        return obj.data

    def show(self, place, changes):
        """Takes changed blocks, None where one is gone. How many objects were rebuilt."""
        if place is not None:
            self.tool.scale = tuple(0.001 * r for r in place.tool_mm)
        touched = set()
        for name, block in changes.items():
            cube = cube_of(name)
            touched.add(cube)
            held = self.blocks.setdefault(cube, {})
            if block is None:
                held.pop(name, None)
            else:
                held[name] = block
        for cube in touched:
            if self.blocks[cube]:
                fill(self._mesh(cube), self.blocks[cube].values())
            else:
                del self.blocks[cube]
                _remove(bpy.data.objects.get(_name_of(cube)))
        return len(touched)

    def corners(self):
        """The triangles as Blender holds them, as argil_clay.corners."""
        found = []
        for mesh in self.meshes:
            positions = array.array("f", bytes(12 * len(mesh.vertices)))
            triangles = array.array("i", bytes(4 * len(mesh.loops)))
            mesh.vertices.foreach_get("co", positions)
            mesh.loops.foreach_get("vertex_index", triangles)
            found += argil_clay.corners(positions, triangles)
        return found
