# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender feels: static meshes by a BVH tree, dynamic scenes by Bullet with a proxy on a spring.

Lengths are Blender's metres; `scale` (Welcome.scale) is mm of the scene for a mm of the hand. A hand
of 10 cm at scale 10 reaches through a metre, which is a size that Bullet handles well.
"""
import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

import argil_bridge as bridge

STEPS_PER_S = 60
SUBSTEPS = 10
PROXY_RADIUS_M = 0.05
PROXY_MASS_KG = 0.02  # its weight hangs on the spring: 0.2 N that are felt while it touches
CUBES = 10
CUBE_M = 0.12
NEAR_M = 0.002  # Bullet keeps bodies apart by about its margin; closer than this is touching


def tree_of(objects):
    """One tree over the meshes of the objects as they stand now; None when they have no faces."""
    vertices, polygons = [], []
    graph = bpy.context.evaluated_depsgraph_get()
    for obj in objects:
        evaluated = obj.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        first = len(vertices)
        vertices += [evaluated.matrix_world @ v.co for v in mesh.vertices]
        polygons += [[first + i for i in polygon.vertices] for polygon in mesh.polygons]
        evaluated.to_mesh_clear()
    return BVHTree.FromPolygons(vertices, polygons) if polygons else None


def nearest(tree, place):
    """Point, normal out of the matter, and signed distance; None without a surface. Inside and
    outside are told by the nearest face, so faces must point outward."""
    point, normal, _, distance = tree.find_nearest(place)
    if point is None:
        return None
    return point, normal, distance if (place - point).dot(normal) >= 0.0 else -distance


class StaticContact:
    """Meshes that do not move, felt with a point. `answer` touches no data of Blender's but the
    tree, so that it may run on another thread."""

    def __init__(self, objects):
        self.tree = tree_of(objects)
        self.place = Vector()  # of the proxy, for who draws it

    def answer(self, state, welcome):
        scale = welcome.scale
        found = self.tree and nearest(self.tree, Vector(bridge.to_scene(state.position_mm, scale)))
        if not found:
            return bridge.Proxy(position_mm=state.position_mm)
        point, normal, distance = found
        proxy = bridge.proxy_at(state, welcome, bridge.to_device(point, scale),
                                bridge.turned_to_device(normal), distance * 1000.0 / scale)
        self.place = Vector(bridge.to_scene(proxy.position_mm, scale))
        return proxy


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


class DynamicContact:
    """Bodies that Bullet moves. The proxy is one of them, drawn to the handle by a spring of the
    stiffness that the hand feels; the law `indirect` gives the hand the same spring's force."""

    def __init__(self, welcome, floor, cubes, start):
        self.scale = welcome.scale
        self.bodies = [floor, *cubes]
        # N at the hand are N in the scene, over a way that is `scale` times as long.
        self.stiffness = welcome.stiffness_n_per_m / self.scale
        _rigid(floor, "PASSIVE")
        for cube in cubes:
            _rigid(cube, "ACTIVE", mass=0.1)
        sphere = bpy.ops.mesh.primitive_uv_sphere_add
        self.handle = _mesh(sphere, "Handle", start, radius=0.3 * PROXY_RADIUS_M)
        _rigid(self.handle, "PASSIVE", group=1).kinematic = True
        self.proxy = _mesh(sphere, "Proxy", start, radius=PROXY_RADIUS_M)
        body = _rigid(self.proxy, "ACTIVE", PROXY_MASS_KG)
        body.collision_shape = "SPHERE"
        body.friction = 0.2
        body.use_deactivation = False
        self._add_spring()
        self.last = Vector(start)

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
        critical = 2.0 * (self.stiffness * PROXY_MASS_KG) ** 0.5
        for axis in "xyz":
            setattr(constraint, f"use_spring_{axis}", True)
            setattr(constraint, f"spring_stiffness_{axis}", self.stiffness)
            setattr(constraint, f"spring_damping_{axis}", critical)

    def answer(self, state, welcome):
        """Steps the world by a frame towards the handle."""
        scene = bpy.context.scene
        self.handle.location = bridge.to_scene(state.position_mm, self.scale)
        scene.frame_set(scene.frame_current + 1)
        graph = bpy.context.evaluated_depsgraph_get()
        place = self.proxy.evaluated_get(graph).matrix_world.translation.copy()
        velocity = (place - self.last) * STEPS_PER_S
        self.last = place
        found = nearest(tree_of(self.bodies), place)
        proxy = bridge.Proxy(position_mm=bridge.to_device(place, self.scale))
        proxy.velocity_mm_per_s = bridge.to_device(velocity, self.scale)
        if found is None:
            return proxy
        point, normal, distance = found
        gap = distance - PROXY_RADIUS_M
        if gap <= NEAR_M:
            proxy.flags |= bridge.CONTACT
            # What the spring gives by Blender's own places, for the log to compare.
            pull = self.stiffness * (place - self.handle.location)
            proxy.direct_force_n = bridge.turned_to_device(pull)
        proxy.distance_mm = gap * 1000.0 / self.scale
        return proxy
