#SPDX - License - Identifier : GPL - 3.0 - or -later
"""blender -b --python blender_boxes.py -- PROJECT

Loads a project as a volume, makes a mesh of each level of each piece, and prints its box as
"NAME: MIN_X MIN_Y MIN_Z MAX_X MAX_Y MAX_Z" where it has a surface. The meshes of Blender 3.4 lie half a voxel
off along x, y and z, where OpenVDB's own of the same grid do not: that is taken back.
"""
import sys

import bpy

project = sys.argv[sys.argv.index("--") + 1]
volume = bpy.data.volumes.new("project")
volume.filepath = project
volume.grids.load()
there = bpy.data.objects.new("project", volume)
bpy.context.collection.objects.link(there)
for grid in volume.grids:
    if "/surface_" not in grid.name:
        continue
    piece = bpy.data.objects.new("piece", bpy.data.meshes.new("piece"))
    bpy.context.collection.objects.link(piece)
    surface = piece.modifiers.new("surface", "VOLUME_TO_MESH")
    surface.object = there
    surface.grid_name = grid.name
    surface.threshold = 0.0
    shown = piece.evaluated_get(bpy.context.evaluated_depsgraph_get())
    half_voxel = 0.5 * grid.matrix_object.to_scale()
    corners = [vertex.co - half_voxel for vertex in shown.data.vertices]
    if not corners:
        continue
    box = [f(c[axis] for c in corners) for f in (min, max) for axis in range(3)]
    print(grid.name + ":", *box)
