# SPDX-License-Identifier: GPL-3.0-or-later
"""Presses the add-on's button in a Blender without a window, and plays its timer until the bridge
has ended, or for some seconds.

Usage: blender -b --factory-startup --python-exit-code 3 --python addon.py -- PORT SECONDS [clay|scene]
"""
import os
import sys
import time

import bpy

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_addon  # noqa: E402
import argil_clay_scene  # noqa: E402
import argil_scene  # noqa: E402

port, seconds, *more = sys.argv[sys.argv.index("--") + 1:]
has_clay = more == ["clay"]
drawn_name = argil_clay_scene.TOOL if has_clay else argil_scene.PROXY
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
argil_scene.add_floor()
argil_addon.register()
bpy.context.scene.argil_port = int(port)
bpy.ops.argil.couple()
end = time.monotonic() + float(seconds)
drawn = 0
is_coupled = False


def has_ended():
    """The bridge said goodbye and, where it has clay, sent all of it."""
    exchange = argil_addon.Coupling.exchange
    if not is_coupled or exchange.status.startswith("coupled"):
        return False
    return not has_clay or exchange.clay.thread.clay.has_ended


while time.monotonic() < end and not has_ended():
    is_coupled |= argil_addon.Coupling.exchange.status.startswith("coupled")
    time.sleep(argil_addon.Coupling.tick())
    obj = bpy.data.objects.get(drawn_name)
    drawn += obj is not None and obj.location.length > 0.0
    if has_clay and drawn == 5:  # as a person may: it comes back
        bpy.data.objects.remove(obj)
clay = argil_addon.Coupling.clay
if has_clay:
    shown = clay.corners()
    seen = argil_addon.Coupling.exchange.clay.thread.clay
    assert seen.has_ended and seen.counts.updates > 5 and seen.counts.malformed == 0, seen.counts
    assert sorted(shown) == sorted(seen.corners()), "Blender has the clay that came"
assert (argil_addon.Coupling.exchange.handle is not None) == (more == ["scene"]), "as the bridge's law asks"
bpy.ops.argil.couple()
assert argil_addon.Coupling.exchange is None, "let go"
argil_addon.unregister()
assert drawn > 10, "the proxy, or the tool, was drawn where the hand is"
