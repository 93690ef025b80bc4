# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies of a grown model on a surface or along a curve, as instances of its collection."""
import bisect
import random

import bpy
from mathutils import Matrix

from .grow import collection_of, root_of


def points_on_surface(mesh, matrix, count, generator):
    """Points with equal density by area."""
    mesh.calc_loop_triangles()
    corners = [[matrix @ mesh.vertices[index].co for index in each.vertices] for each in mesh.loop_triangles]
    sums, total = [], 0.0
    for a, b, c in corners:
        total += (b - a).cross(c - a).length / 2
        sums.append(total)
    for _ in range(count if total else 0):
        a, b, c = corners[min(bisect.bisect(sums, generator.random() * total), len(corners) - 1)]
        u, v = generator.random(), generator.random()
        if u + v > 1:
            u, v = 1 - u, 1 - v
        yield a + u * (b - a) + v * (c - a)


def points_on_curve(mesh, matrix, count):
    """Points at equal distances along the edges, both ends included."""
    edges = [(matrix @ mesh.vertices[a].co, matrix @ mesh.vertices[b].co) for a, b in (each.vertices for each in mesh.edges)]
    sums, total = [], 0.0
    for a, b in edges:
        total += (b - a).length
        sums.append(total)
    for index in range(count if total else 0):
        at = total * index / max(count - 1, 1)
        place = min(bisect.bisect_left(sums, at), len(edges) - 1)
        a, b = edges[place]
        length = (b - a).length or 1
        yield b - (b - a) * ((sums[place] - at) / length)


class SEEDMESH_OT_scatter(bpy.types.Operator):
    """Puts copies of the selected model on the active surface or curve"""
    bl_idname = "seedmesh.scatter"
    bl_label = "Copies on the active object"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type in {"MESH", "CURVE"} and root_of(context.object) is None

    def execute(self, context):
        settings, target = context.scene.seedmesh, context.object
        root = next((root_of(each) for each in context.selected_objects if root_of(each)), None)
        if root is None:
            self.report({"ERROR"}, "Select a grown model, then the surface or the curve")
            return {"CANCELLED"}
        generator = random.Random(settings.seed)
        evaluated = target.evaluated_get(context.evaluated_depsgraph_get())
        mesh = evaluated.to_mesh()
        if target.type == "CURVE":
            points = list(points_on_curve(mesh, target.matrix_world, settings.count))
        else:
            points = list(points_on_surface(mesh, target.matrix_world, settings.count, generator))
        evaluated.to_mesh_clear()
        model = collection_of(root)
        model.instance_offset = root.matrix_world.translation
        copies = bpy.data.collections.new(f"{model.name}_copies")
        context.scene.collection.children.link(copies)
        for index, point in enumerate(points):
            copy = bpy.data.objects.new(f"{model.name}_{index}", None)
            copy.instance_type = "COLLECTION"
            copy.instance_collection = model
            copy.matrix_world = Matrix.Translation(point) @ Matrix.Rotation(generator.random() * 6.283185307, 4, "Z")
            copies.objects.link(copy)
        return {"FINISHED"}


classes = (SEEDMESH_OT_scatter,)
