# SPDX-License-Identifier: GPL-3.0-or-later
"""What the three scripts share: Blender runs each of them in a namespace of its own."""
import argparse
import csv
import sys

import bpy

import argil_bridge as bridge
import argil_clay
import argil_clay_scene
import argil_scene

client = None
contact = None
clay = None  # its objects, where the bridge has some
handle = None  # its object, where the bridge has a scene of its own
options = None
rows = []


def parse():
    """The arguments after --."""
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="init.py", description="Blender, felt through argil bridge")
    parser.add_argument("--port", type=int, default=bridge.USUAL_PORT)
    parser.add_argument("--key", help="the bridge's key file, where it is not in its usual place")
    parser.add_argument("--rate", type=float, default=60.0, help="of static scenes, Hz")
    parser.add_argument("--scene", choices=("floor", "file", "cubes", "clay"), default="floor",
                        help="a floor; the meshes of the file that is open; cubes to push; or the clay "
                             "of argil bridge --clay")
    parser.add_argument("--silence", type=float, default=30.0, help="s until it gives up")
    parser.add_argument("--log", help="CSV of what Blender saw in each frame")
    parser.add_argument("--save", help="STL of the clay as Blender has it at the end")
    return parser.parse_args(words)


def make_contact(welcome):
    """The scene and what touches it; the hand begins above it."""
    global clay
    law = bridge.LAWS[welcome.law]
    if law == "scene":
        return make_handle()
    if (options.scene == "clay") != (law == "clay"):
        raise RuntimeError("--scene clay goes with 'argil bridge --clay', and no other scene does")
    if options.scene == "cubes" and law == "plane":
        raise RuntimeError(f"--scene cubes is not felt by the law {law}; start "
                           "'argil bridge --coupling indirect --scale 10'")
    if options.scene == "file":
        static = argil_scene.StaticContact(argil_scene.felt_objects())
        if static.surface.tree is None:
            raise RuntimeError(f"'{bpy.data.filepath or 'the startup file'}' shows no mesh with faces; "
                               "open one that does before the --python, or show what is hidden")
        return static
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    if options.scene == "clay":
        clay = argil_clay_scene.ClayObjects()
        return argil_clay.ClayContact(client)
    if options.scene == "floor":
        return argil_scene.StaticContact([argil_scene.add_floor()])
    argil_scene.start_world()
    start = (-0.2, 0.0, 0.3)
    return argil_scene.DynamicContact(welcome, argil_scene.add_floor(), argil_scene.add_cubes(), start)


def make_handle():
    """Of `argil bridge --scene` only the handle is shown: in the file that is open, or in an empty scene."""
    global handle
    if options.scene not in ("floor", "file"):
        raise RuntimeError(f"--scene {options.scene} is not felt, 'argil bridge --scene' gives the force "
                           "itself; leave it out, or say --scene file")
    if options.scene == "floor":
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
    handle = argil_scene.proxy_object()
    return bridge.HandleContact()


def step():
    """One frame: feels where the handle is, answers, and takes a line of the log."""
    proxy = contact.answer(client.state, client.welcome)
    client.answer(proxy)
    if clay is not None:
        draw()
    if handle is not None:
        handle.location = contact.place
    rows.append((len(rows), *client.state.position_mm, *client.state.force_n, *proxy.position_mm,
                 int(bool(proxy.flags & bridge.CONTACT)), proxy.distance_mm))


def draw():
    """The clay as it is now, and the tool in it."""
    clay.show(*contact.thread.take())
    clay.tool.location = contact.place


def finish_clay():
    """What the bridge sent last, and what Blender has of it all."""
    contact.thread.wait_for_end(10.0)
    contact.thread.end()
    draw()
    triangles = clay.corners()
    if options.save:
        argil_clay.write_stl(options.save, triangles)
    print("exit: " + contact.report(triangles) + f", {len(clay.meshes)} objects")


def end():
    """Says goodbye before all else: the hand is let go. Then the log."""
    try:
        client.close()
    finally:
        save()


def save():
    if clay is not None and contact is not None:
        finish_clay()
    if not options.log:
        return
    with open(options.log, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(("frame", "x_mm", "y_mm", "z_mm", "force_x_n", "force_y_n", "force_z_n",
                         "proxy_x_mm", "proxy_y_mm", "proxy_z_mm", "contact", "distance_mm"))
        writer.writerows(rows)
