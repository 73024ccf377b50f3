# SPDX-License-Identifier: GPL-3.0-or-later
"""The first of the Falcon report's three scripts: makes the scene and greets the bridge.

blender [FILE.blend] -b --factory-startup --python-exit-code 3 --python init.py \
    --python BoucleCouplage.py --python exit.py -- [--port N] [--key FILE] \
    [--rate HZ] [--scene floor|file|cubes|clay] [--log FILE.csv] \
     [--save CLAY.stl]
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import argil_bridge  # noqa: E402
import argil_scene  # noqa: E402
import argil_session as session  # noqa: E402

session.options = session.parse()
rate = argil_scene.STEPS_PER_S if session.options.scene == "cubes" else session.options.rate
session.client = argil_bridge.Client(rate, session.options.port, key_file=session.options.key)
if not session.client.connect(session.options.silence):
    raise RuntimeError(session.client.unwelcome())
try:
    session.contact = session.make_contact(session.client.welcome)
except BaseException:
    session.end()
    raise
print(f"init: coupled at {rate:g} Hz with the law "
      f"{argil_bridge.LAWS[session.client.welcome.law]}", flush=True)
