# SPDX-License-Identifier: GPL-3.0-or-later
"""Add-on: the sidebar's panel "Argil" couples the meshes of the open file with `argil bridge`.

Install: Edit > Preferences > Add-ons > Install, with this file. Blender copies it alone: the other
argil_*.py must be put beside the copy, or ARGIL_BLENDER must name their folder. Choose a device, where
Blender's Python has the package argil; else start `argil bridge`. Then press Couple. The exchange runs on a thread of its own that touches nothing of bpy: it feels a
tree which the main thread made. A timer of the main thread draws the proxy and rebuilds the tree
when meshes changed, appeared or went.

Of `argil bridge --clay` the clay itself is felt: another thread reads its surface, and the timer puts
what changed into objects of the scene. Of `argil bridge --scene` that scene is felt and no mesh: the
timer draws the handle.
"""
import os
import sys
import threading
import time

import bpy

sys.path.insert(0, os.environ.get("ARGIL_BLENDER", os.path.dirname(os.path.abspath(__file__))))

import argil_bridge as bridge  # noqa: E402
import argil_clay  # noqa: E402
import argil_clay_scene  # noqa: E402
import argil_scene  # noqa: E402

try:  # with the package the servo runs in this process
    from argil.local_bridge import LocalClient
except ImportError:
    LocalClient = None

bl_info = {
    "name": "Argil: feel the scene",
    "author": "The Argil authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "View3D > Sidebar > Argil",
    "description": "Couples a haptic device with the scene through argil bridge",
    "category": "Interface",
}

DRAW_EVERY_S = 1.0 / 60.0
DEVICES = [("bridge", "argil bridge", "Another program has the device: start argil bridge"),
           ("falcon", "Falcon", "A Novint Falcon, with its servo in Blender's process"),
           ("sim", "Simulated", "A simulated Falcon, whose hand presses on the origin")]


def usable_devices(_self, _context):
    return DEVICES if LocalClient else DEVICES[:1]


class Exchange(threading.Thread):
    """Answers the bridge's states at its rate until it is told to end. No bpy in here."""

    def __init__(self, port, rate_hz, contact, device="bridge"):
        super().__init__(daemon=True)
        self.client = None
        self._make_client = (lambda: bridge.Client(rate_hz, port)) if device == "bridge" else \
            (lambda: LocalClient(rate_hz, device=device))
        self.contact = contact  # replaced as a whole by the main thread
        self.clay = None        # a ClayContact, from when a bridge that has clay first answers
        self.handle = None      # a HandleContact, while the bridge has a scene of its own
        self._waits = "waiting for argil bridge" if device == "bridge" else \
            "waiting for the device: home it as the terminal says" if device == "falcon" else "starting"
        self.status = self._waits
        self._ends = threading.Event()

    def run(self):
        try:
            self.client = self._make_client()
            while not self._ends.is_set():
                if self.client.connect(1.0):
                    self._couple()
                else:
                    self.status = self.client.unwelcome()
        except Exception as refusal:  # of the bridge, of a number that it would not take, of the device
            self.status = str(refusal)
        finally:
            if self.client is not None:
                self.client.close()
            if self.clay is not None:
                self.clay.thread.end()

    def _couple(self):
        law = bridge.LAWS[self.client.welcome.law]
        self.status = "coupled, law " + law
        if law == "clay" and self.clay is None:
            self.clay = argil_clay.ClayContact(self.client)
        self.handle = bridge.HandleContact() if law == "scene" else None
        due = time.monotonic()
        while not self._ends.is_set() and self.client.wait(1.0):
            contact = self.clay if law == "clay" else self.handle or self.contact
            self.client.answer(contact.answer(self.client.state, self.client.welcome))
            due = max(due + 1.0 / self.client.rate_hz, time.monotonic() - 0.1)
            time.sleep(max(0.0, due - time.monotonic()))
        self.status = self._waits

    def end(self):
        self._ends.set()
        self.join()


class Coupling:
    """The main thread's side."""

    exchange = None
    is_changed = False
    clay = None  # its objects
    shown = frozenset()  # names of what the contact was made of

    @classmethod
    def start(cls, scene):
        cls.exchange = Exchange(scene.argil_port, scene.argil_rate, cls.new_contact(), scene.argil_device)
        cls.exchange.start()
        if not bpy.app.timers.is_registered(tick):
            bpy.app.timers.register(tick, persistent=True)  # also over File > Open

    @classmethod
    def stop(cls):
        if cls.exchange is not None:
            cls.exchange.end()
        cls.exchange, cls.clay = None, None

    @staticmethod
    def new_contact():
        return argil_scene.StaticContact(argil_scene.felt_objects())

    @classmethod
    def tick(cls):
        if cls.exchange is None:
            return None
        if cls.exchange.clay is not None:
            cls.draw_clay(cls.exchange.clay)
            return DRAW_EVERY_S
        shown = {obj.name_full for obj in argil_scene.felt_objects()}
        if cls.is_changed or shown != cls.shown:  # nothing tells of what is deleted or hidden
            cls.is_changed, cls.shown = False, shown
            cls.exchange.contact = cls.new_contact()
        contact = cls.exchange.handle or cls.exchange.contact
        argil_scene.proxy_object().location = contact.place
        return DRAW_EVERY_S

    @classmethod
    def draw_clay(cls, contact):
        if cls.clay is None:
            cls.clay = argil_clay_scene.ClayObjects()
        cls.clay.show(*contact.thread.take())
        cls.clay.tool.location = contact.place


def tick():
    return Coupling.tick()


@bpy.app.handlers.persistent
def see_changes(_scene, graph):
    """A mesh was moved or edited: its tree is old."""
    if any(not argil_scene.is_ours(update.id) and (update.is_updated_geometry or update.is_updated_transform)
           for update in graph.updates if isinstance(update.id, bpy.types.Object)):
        Coupling.is_changed = True


@bpy.app.handlers.persistent
def see_file(*_):
    """Another file was opened."""
    Coupling.is_changed = True


class ARGIL_OT_couple(bpy.types.Operator):
    """Begin or end feeling the meshes that are visible"""

    bl_idname = "argil.couple"
    bl_label = "Couple"

    def execute(self, context):
        if Coupling.exchange is None:
            Coupling.start(context.scene)
        else:
            Coupling.stop()
        return {"FINISHED"}


class ARGIL_PT_panel(bpy.types.Panel):
    bl_label = "Argil"
    bl_idname = "ARGIL_PT_panel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Argil"

    def draw(self, context):
        layout = self.layout
        layout.prop(context.scene, "argil_device")
        if context.scene.argil_device == "bridge":
            layout.prop(context.scene, "argil_port")
        layout.prop(context.scene, "argil_rate")
        exchange = Coupling.exchange
        layout.operator("argil.couple", text="Couple" if exchange is None else "Let go")
        if exchange is not None:
            layout.label(text=exchange.status)
            if exchange.clay is not None and exchange.clay.note:
                layout.label(text=exchange.clay.note, icon="ERROR")
            if exchange.handle is not None:
                layout.label(text="The bridge's own scene is felt, and nothing of this one")
            elif exchange.contact.surface.tree is None:
                layout.label(text="No mesh with faces is visible: nothing to feel")


CLASSES = (ARGIL_OT_couple, ARGIL_PT_panel)


def register():
    bpy.types.Scene.argil_device = bpy.props.EnumProperty(name="Device", items=usable_devices)
    bpy.types.Scene.argil_port = bpy.props.IntProperty(
        name="Port", default=bridge.USUAL_PORT, min=1, max=65535)
    bpy.types.Scene.argil_rate = bpy.props.FloatProperty(
        name="Rate / Hz", default=200.0, min=20.0, max=1000.0)
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.app.handlers.depsgraph_update_post.append(see_changes)
    bpy.app.handlers.load_post.append(see_file)


def unregister():
    Coupling.stop()
    bpy.app.handlers.depsgraph_update_post.remove(see_changes)
    bpy.app.handlers.load_post.remove(see_file)
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
    del bpy.types.Scene.argil_port, bpy.types.Scene.argil_rate, bpy.types.Scene.argil_device


if __name__ == "__main__":
    register()
