# SPDX-License-Identifier: GPL-3.0-or-later
"""Grow a model into a collection of its own, and grow it again in its position."""
import glob
import io
import json
import os
import random
import re
import tempfile
import zipfile

import bpy

from . import service

request_key = "seedmesh_request"
materials_key = "seedmesh_materials"  # names of the materials that came with the model


def model_name(request):
    return f"{request.get('preset') or request.get('generator')}_{request.get('seed', 0)}"


def repair_numpy():
    """The importer of Blender 3.4 uses numpy.bool, which the numpy of Debian 12 lacks."""
    import numpy
    if "bool" not in numpy.__dict__:
        numpy.bool = bool


def import_file(path):
    """Imports a glTF file and gives the new objects."""
    repair_numpy()
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=path)
    return [each for each in bpy.data.objects if each not in before]


def move(objects, collection):
    for each in objects:
        for old in list(each.users_collection):
            old.objects.unlink(each)
        collection.objects.link(each)


def part_collection(parent, name, is_hidden):
    collection = bpy.data.collections.new(name)
    parent.children.link(collection)
    collection.hide_viewport = collection.hide_render = is_hidden
    return collection


def import_model(data, request, collection):
    """Puts the model into the collection: the finest level itself, coarser levels and collision bodies in hidden collections."""
    name = model_name(request)
    actions, materials = set(bpy.data.actions), set(bpy.data.materials)
    with tempfile.TemporaryDirectory() as folder:
        if data[:2] == b"PK":
            zipfile.ZipFile(io.BytesIO(data)).extractall(folder)
            found = {int((re.search(r"_LOD(\d+)\.gltf$", path) or [0, 0])[1]): path for path in glob.glob(os.path.join(folder, "*.gltf"))}
        else:
            found = {0: os.path.join(folder, name + ".glb")}
            with open(found[0], "wb") as file:
                file.write(data)
        root = None
        for level, path in sorted(found.items()):
            objects = import_file(path)
            bodies = [each for each in objects if re.match(r"(collision|UCX)_", each.name)]
            where = collection if level == 0 else part_collection(collection, f"{name}_LOD{level}", is_hidden=True)
            move([each for each in objects if each not in bodies], where)
            if bodies:
                move(bodies, part_collection(collection, f"{name}_collision", is_hidden=True))
            top = next(each for each in objects if each.parent not in objects)
            if root is None:
                root = top
                root.name = name
            else:
                top.parent = root
        root[request_key] = json.dumps(request, sort_keys=True)
        if request.get("output", {}).get("animation") == "growth":
            frames = [each.frame_range[1] for each in bpy.data.actions if each not in actions]
            if frames:  # full-grown instead of the first frame, where a plant is a centimetre high
                bpy.context.scene.frame_end = max(bpy.context.scene.frame_end, int(max(frames)))
                bpy.context.scene.frame_set(int(max(frames)))
        root[materials_key] = json.dumps(sorted(each.name for each in bpy.data.materials if each not in materials))
    return root


def root_of(obj):
    """The root of a grown model that the object belongs to, or None."""
    while obj is not None and request_key not in obj:
        obj = obj.parent
    return obj


def base_name(name):
    return re.sub(r"\.\d{3}$", "", name)


def collection_of(root):
    return next(each for each in root.users_collection)


class SEEDMESH_OT_grow(bpy.types.Operator):
    """Grows the model of the panel at the 3D cursor"""
    bl_idname = "seedmesh.grow"
    bl_label = "Grow"
    bl_options = {"REGISTER", "UNDO"}
    preset: bpy.props.StringProperty(options={"SKIP_SAVE"})
    seed: bpy.props.IntProperty(default=-1, options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, _context):
        return service.is_allowed()

    def execute(self, context):
        settings, client = context.scene.seedmesh, service.client()
        if self.preset:
            settings.preset = self.preset
        if self.seed >= 0:
            settings.seed = self.seed
        request = settings.request()
        location = context.scene.cursor.location.copy()

        def done(model, error):
            settings.is_busy = False
            settings.errors.clear()
            if error:
                settings.show_error(error)
                return
            collection = bpy.data.collections.new(model_name(request))
            bpy.context.scene.collection.children.link(collection)
            root = import_model(model.data, request, collection)
            root.location = location
            bpy.context.view_layer.objects.active = root

        settings.is_busy = True
        service.call(lambda: client.generate(request), done)
        if settings.errors:
            self.report({"ERROR"}, settings.errors[0].message)
            return {"CANCELLED"}
        return {"FINISHED"}


class SEEDMESH_OT_regrow(bpy.types.Operator):
    """Grows the active model again with another seed; its position, its materials and its copies stay"""
    bl_idname = "seedmesh.regrow"
    bl_label = "Grow again"
    bl_options = {"REGISTER", "UNDO"}
    seed: bpy.props.IntProperty(default=-1, description="-1 draws a seed", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return service.is_allowed() and root_of(context.object) is not None

    def execute(self, context):
        settings, client = context.scene.seedmesh, service.client()
        old = root_of(context.object)
        request = json.loads(old[request_key])
        request["seed"] = self.seed if self.seed >= 0 else random.randrange(1 << 31)
        old_name = old.name

        def done(model, error):
            settings.is_busy = False
            settings.errors.clear()
            if error:
                settings.show_error(error)
                return
            root = bpy.data.objects.get(old_name)
            if root is None:
                return
            replace(root, model.data, request)

        settings.is_busy = True
        service.call(lambda: client.generate(request), done)
        if settings.errors:
            self.report({"ERROR"}, settings.errors[0].message)
            return {"CANCELLED"}
        return {"FINISHED"}


def replace(old, data, request):
    """Takes the old model out of its collection and puts the new one there. Copies show that collection, so they change, too."""
    collection = collection_of(old)
    matrix, parent = old.matrix_world.copy(), old.parent
    kept = {base_name(name): bpy.data.materials[name] for name in json.loads(old[materials_key]) if name in bpy.data.materials}
    for child in list(collection.children):
        for each in list(child.objects):
            bpy.data.objects.remove(each, do_unlink=True)
        bpy.data.collections.remove(child)
    for each in [*old.children_recursive, old]:
        bpy.data.objects.remove(each, do_unlink=True)
    root = import_model(data, request, collection)
    collection.name = model_name(request)
    root.parent = parent
    root.matrix_world = matrix
    names = []
    for name in json.loads(root[materials_key]):
        known, new = kept.get(base_name(name)), bpy.data.materials[name]
        if known:
            new.user_remap(known)
            bpy.data.materials.remove(new)
        names.append(known.name if known else name)
    root[materials_key] = json.dumps(names)
    bpy.context.view_layer.objects.active = root
    return root


classes = (SEEDMESH_OT_grow, SEEDMESH_OT_regrow)
