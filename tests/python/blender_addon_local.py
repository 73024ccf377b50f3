# SPDX-License-Identifier: GPL-3.0-or-later
"""In a Blender without a window: the add-on feels a floor with the servo in Blender's own process.

Usage: blender -b --factory-startup --python-use-system-env --python-exit-code 3 --python FILE
"""
import os
import sys
import time

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/blender"))

import argil_addon  # noqa: E402
import argil_scene  # noqa: E402

bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
argil_scene.add_floor()
argil_addon.register()
assert argil_addon.LocalClient is not None, "the package argil is there"
bpy.context.scene.argil_device = "sim"
bpy.ops.argil.couple()
exchange = argil_addon.Coupling.exchange
end = time.monotonic() + 20.0
most_n = 0.0
while time.monotonic() < end and most_n < 2.5:
    time.sleep(argil_addon.Coupling.tick())
    if exchange.client is not None and exchange.client.state is not None:
        most_n = max(most_n, exchange.client.state.force_n[1])
assert exchange.status == "coupled, law plane", exchange.status
bpy.ops.argil.couple()
argil_addon.unregister()
assert most_n > 2.5, f"the floor pushed with {most_n} N"
assert exchange.client.report["ticks"] > 1000
print("felt in Blender's process:", most_n, "N")
