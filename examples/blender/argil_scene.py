# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender feels: static meshes by a BVH tree, dynamic scenes by Bullet with a proxy on a spring.

Lengths are Blender's metres; `scale` (Welcome.scale) is mm of the scene for a mm of the hand. A hand
of 10 cm at scale 10 reaches through a metre, which is a size that Bullet handles well.
"""
from collections import Counter
from dataclasses import dataclass

import bpy
from mathutils import Vector, geometry
from mathutils.bvhtree import BVHTree

import argil_bridge as bridge

PROXY = "Argil proxy"
STEPS_PER_S = 60
SUBSTEPS = 10
OPEN_DEPTH_MM = 10.0  # of the hand, behind a mesh that is not closed
PROXY_RADIUS_M = 0.05
PROXY_MASS_KG = 0.02  # more for a spring that Bullet would soften
CUBES = 10
CUBE_M = 0.12
TOUCH_M = 1e-4  # Bullet presses bodies together within some micrometres; what is closer touches


def is_ours(obj):
    """The proxy, the tool and the clay are drawn, not felt."""
    return obj.name.startswith("Argil ")


def proxy_object():
    """What shows where the proxy is, or a handle that touches nothing; made where it is not there."""
    proxy = bpy.data.objects.get(PROXY)
    if proxy is None:
        proxy = bpy.data.objects.new(PROXY, None)
        proxy.empty_display_type = "SPHERE"
        proxy.empty_display_size = 0.01
        bpy.context.scene.collection.objects.link(proxy)
    return proxy


def felt_objects():
    """What shows in the view layer and may bring a mesh: itself one, or an instance of a collection."""
    return [obj for obj in bpy.context.scene.objects
            if (obj.type == "MESH" or obj.instance_type != "NONE") and obj.visible_get()
            and not is_ours(obj)]


def _instances_of(objects):
    """Mesh and matrix of what the objects show now, with modifiers and collections applied."""
    graph = bpy.context.evaluated_depsgraph_get()
    for instance in graph.object_instances:
        owner = instance.parent if instance.is_instance else instance.object
        is_shown = instance.is_instance or instance.show_self
        if is_shown and instance.object.type == "MESH" and owner.original in objects:
            yield instance.object, instance.matrix_world.copy()


@dataclass
class Nearest:
    """The place of a surface that is nearest to a given one."""

    point: Vector
    normal: Vector  # out of the matter
    distance: float  # negative inside
    is_open: bool  # of a mesh that is not closed
    is_beside: bool = False  # behind the plane of such a mesh, but past its rim


class Surface:
    """The faces of some objects as they stand now. `nearest` needs nothing of bpy."""

    def __init__(self, objects):
        self.vertices, self.polygons = [], []
        self.rims = {}  # of each face of a mesh that is not closed: those of its edges that end it
        for obj, matrix in _instances_of(set(objects)):
            mesh = obj.to_mesh()
            self._add(mesh, matrix)
            obj.to_mesh_clear()
        self.tree = BVHTree.FromPolygons(self.vertices, self.polygons) if self.polygons else None

    def _add(self, mesh, matrix):
        first = len(self.vertices)
        self.vertices += [matrix @ v.co for v in mesh.vertices]
        faces_at = Counter(key for polygon in mesh.polygons for key in polygon.edge_keys)
        is_open = any(count == 1 for count in faces_at.values())
        turn = -1 if matrix.determinant() < 0.0 else 1  # a mirror turns faces inside out
        for polygon in mesh.polygons:
            corners = [first + i for i in polygon.vertices][::turn]
            # A face without area has no normal.
            if not geometry.normal([self.vertices[i] for i in corners]).length > 0.5:
                continue
            if is_open:
                self.rims[len(self.polygons)] = [
                    [self.vertices[first + i] for i in key]
                    for key in polygon.edge_keys if faces_at[key] == 1]
            self.polygons.append(corners)

    def nearest(self, place):
        """The Nearest; None without a surface. Inside and outside are told by the nearest face, so
        faces must point outward."""
        found = self.tree.find_nearest(place) if self.tree else None
        if not found or found[0] is None:
            return None
        # An edge or a corner is as near on all its faces: the one that looks at the place most
        # squarely tells the side, the others may tell the wrong one where the edge is sharp.
        hits = self.tree.find_nearest_range(place, found[3] * (1.0 + 1e-4) + 1e-6) or [found]
        point, normal, face, distance = max(hits, key=lambda hit: abs((place - hit[0]).dot(hit[1])))
        if (place - point).dot(normal) >= 0.0:
            return Nearest(point, normal, distance, face in self.rims)
        if distance > 0.0 and any(self._is_on_rim(hit) for hit in hits):
            return Nearest(point, (place - point) / distance, distance, True, True)
        return Nearest(point, normal, -distance, face in self.rims)

    def _is_on_rim(self, hit):
        """Whether the nearest point of a face is where the mesh ends."""
        point, _, face, _ = hit
        for a, b in self.rims.get(face, ()):
            foot, _ = geometry.intersect_point_line(point, a, b)
            if (foot - point).length <= 1e-4 * (b - a).length:
                return True
        return False


class StaticContact:
    """Meshes that do not move, felt with a point. `answer` touches no data of Blender's but the
    surface, so that it may run on another thread. A mesh that is not closed is felt from its front:
    who comes round its rim, or pushes OPEN_DEPTH_MM through it, is free until in front again."""

    def __init__(self, objects):
        self.surface = Surface(objects)
        self.place = Vector()  # of the proxy, for who draws it
        self._is_behind = False  # an open mesh

    def answer(self, state, welcome):
        scale = welcome.scale
        found = self.surface.nearest(Vector(bridge.to_scene(state.position_mm, scale)))
        if not found:
            return self._free(state, scale)
        distance_mm = found.distance * 1000.0 / scale
        if found.is_open:
            self._is_behind = (found.is_beside or distance_mm < -OPEN_DEPTH_MM or
                               (self._is_behind and distance_mm < 0.0))
            if self._is_behind:
                return self._free(state, scale, abs(distance_mm))
        proxy = bridge.proxy_at(state, welcome, bridge.to_device(found.point, scale),
                                bridge.turned_to_device(found.normal), distance_mm)
        self.place = Vector(bridge.to_scene(proxy.position_mm, scale))
        return proxy

    def _free(self, state, scale, distance_mm=0.0):
        self.place = Vector(bridge.to_scene(state.position_mm, scale))
        return bridge.Proxy(position_mm=state.position_mm, distance_mm=distance_mm)


def _rigid(obj, kind, mass=1.0, group=0, margin=0.0):
    bpy.context.scene.rigidbody_world.collection.objects.link(obj)
    body = obj.rigid_body
    body.type = kind
    body.mass = mass
    body.use_margin = True
    body.collision_margin = margin
    body.collision_collections = [n == group for n in range(20)]
    return body


def _mesh(make, name, location, **arguments):
    make(location=location, **arguments)
    bpy.context.object.name = name
    return bpy.context.object


def start_world():
    scene = bpy.context.scene
    scene.render.fps = STEPS_PER_S
    scene.frame_start, scene.frame_end = 1, 1_000_000
    bpy.ops.rigidbody.world_add()
    world = scene.rigidbody_world
    world.collection = bpy.data.collections.new("Bodies")
    world.constraints = bpy.data.collections.new("Springs")
    world.substeps_per_frame = SUBSTEPS
    world.solver_iterations = 50
    world.point_cache.frame_start = 1
    world.point_cache.frame_end = 1_000_000


def add_floor():
    """A slab, its top at z = 0."""
    floor = _mesh(bpy.ops.mesh.primitive_cube_add, "Floor", (0.0, 0.0, -0.5), size=1.0)
    floor.scale = (4.0, 4.0, 1.0)
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
    return floor


def add_cubes():
    """Two rows of cubes on the floor, in the way of a hand that goes along x."""
    cubes = []
    for n in range(CUBES):
        place = (0.15 + 0.13 * (n % 5), 0.065 * (2 * (n // 5) - 1), 0.5 * CUBE_M)
        cubes.append(_mesh(bpy.ops.mesh.primitive_cube_add, f"Cube{n}", place, size=CUBE_M))
    return cubes


def proxy_mass(stiffness, substep_s):
    """kg of a proxy whose spring Bullet leaves alone: it caps a spring at mass / (4 substep)^2."""
    return max(PROXY_MASS_KG, 1.01 * stiffness * (4.0 * substep_s) ** 2)


class DynamicContact:
    """Bodies that Bullet moves. The proxy is one of them, drawn to the handle by a spring of the
    stiffness that the hand feels; the law `indirect` gives the hand the same spring's force. `start` is
    where the proxy begins, metres, clear of the bodies."""

    def __init__(self, welcome, floor, cubes, start):
        scene = bpy.context.scene
        self.scale = welcome.scale
        self.bodies = [floor, *cubes]
        # N at the hand are N in the scene, over a way that is `scale` times as long.
        self.stiffness = welcome.stiffness_n_per_m / self.scale
        self.mass = proxy_mass(self.stiffness, 1.0 / (STEPS_PER_S * SUBSTEPS))
        # The spring's other end is higher by what the proxy's weight stretches it: none is felt.
        self.weight_off = -self.mass * scene.gravity / self.stiffness
        _rigid(floor, "PASSIVE")
        for cube in cubes:
            _rigid(cube, "ACTIVE", mass=0.1)
        sphere = bpy.ops.mesh.primitive_uv_sphere_add
        self.handle = _mesh(sphere, "Handle", start, radius=0.3 * PROXY_RADIUS_M)
        _rigid(self.handle, "PASSIVE", group=1).kinematic = True
        self.proxy = _mesh(sphere, "Proxy", start, radius=PROXY_RADIUS_M)
        body = _rigid(self.proxy, "ACTIVE", self.mass)
        body.collision_shape = "SPHERE"
        body.friction = 0.2
        body.use_deactivation = False
        self._add_spring()
        self.last = Vector(start)
        scene.frame_set(scene.frame_start)
        self._step_to(start)  # the spring has no length where its ends are at the first step

    def _add_spring(self):
        spring = bpy.data.objects.new("Spring", None)
        spring.location = self.handle.location
        bpy.context.scene.collection.objects.link(spring)
        bpy.context.scene.rigidbody_world.constraints.objects.link(spring)
        constraint = spring.rigid_body_constraint
        constraint.type = "GENERIC_SPRING"
        constraint.spring_type = "SPRING2"
        constraint.object1, constraint.object2 = self.handle, self.proxy
        constraint.disable_collisions = True
        critical = 2.0 * (self.stiffness * self.mass) ** 0.5
        for axis in "xyz":
            setattr(constraint, f"use_spring_{axis}", True)
            setattr(constraint, f"spring_stiffness_{axis}", self.stiffness)
            setattr(constraint, f"spring_damping_{axis}", critical)

    def _step_to(self, place):
        """A frame with the spring's end there; where the proxy is then."""
        scene = bpy.context.scene
        self.handle.location = place
        scene.frame_set(scene.frame_current + 1)
        graph = bpy.context.evaluated_depsgraph_get()
        return self.proxy.evaluated_get(graph).matrix_world.translation.copy()

    def answer(self, state, welcome):
        """Steps the world by a frame towards the handle."""
        hand = Vector(bridge.to_scene(state.position_mm, self.scale))
        place = self._step_to(hand + self.weight_off)
        velocity = (place - self.last) * STEPS_PER_S
        self.last = place
        proxy = bridge.Proxy(position_mm=bridge.to_device(place, self.scale))
        proxy.velocity_mm_per_s = bridge.to_device(velocity, self.scale)
        found = Surface(self.bodies).nearest(place)
        if found is None:
            return proxy
        # The plane that the middle of the proxy is kept from: the hand is never drawn through it.
        proxy.flags |= bridge.PLANE
        middle = found.point + PROXY_RADIUS_M * found.normal
        proxy.plane_point_mm = bridge.to_device(middle, self.scale)
        proxy.plane_normal = bridge.turned_to_device(found.normal)
        gap = found.distance - PROXY_RADIUS_M
        if gap <= TOUCH_M:
            proxy.flags |= bridge.CONTACT
            # What the spring gives, of which the law `direct` makes the force: never into the body.
            pull = self.stiffness * (place - hand)
            if pull.dot(found.normal) > 0.0:
                proxy.direct_force_n = bridge.turned_to_device(pull)
        proxy.distance_mm = gap * 1000.0 / self.scale
        return proxy
