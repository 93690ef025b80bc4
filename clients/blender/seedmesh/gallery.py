# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery of presets, and the parameters of the chosen one."""
import bpy

from . import pictures, service


class SEEDMESH_OT_gallery(bpy.types.Operator):
    """Lists the presets of the server with their pictures"""
    bl_idname = "seedmesh.gallery"
    bl_label = "Load gallery"

    @classmethod
    def poll(cls, _context):
        return service.is_allowed()

    def execute(self, context):
        settings, client = context.scene.seedmesh, service.client()

        def done(presets, error):
            settings.errors.clear()
            if error:
                settings.show_error(error)
                return
            settings.presets.clear()
            for each in presets:
                row = settings.presets.add()
                row.name, row.title, row.generator, row.text = each["name"], each["title"], each["generator"], each["description"]

        def work():
            presets = client.presets()
            pictures.fetch(client, [each["name"] for each in presets])
            return presets

        service.call(work, done)
        return {"CANCELLED"} if settings.errors else {"FINISHED"}


class SEEDMESH_OT_parameters(bpy.types.Operator):
    """Shows the parameters of the preset, from the schema of its generator"""
    bl_idname = "seedmesh.parameters"
    bl_label = "Show parameters"

    @classmethod
    def poll(cls, _context):
        return service.is_allowed()

    def execute(self, context):
        settings, client, preset = context.scene.seedmesh, service.client(), context.scene.seedmesh.preset

        def work():
            request = client.preset(preset)
            return request, client.schema(request["generator"])

        def done(answer, error):
            settings.errors.clear()
            if error:
                settings.show_error(error)
            else:
                settings.read_schema(answer[0]["generator"], answer[1], answer[0])

        service.call(work, done)
        return {"CANCELLED"} if settings.errors else {"FINISHED"}


class SEEDMESH_OT_picture(bpy.types.Operator):
    """Shows a picture of the model with these parameters, drawn by the service"""
    bl_idname = "seedmesh.picture"
    bl_label = "Show picture"

    @classmethod
    def poll(cls, _context):
        return service.is_allowed()

    def execute(self, context):
        settings, client = context.scene.seedmesh, service.client()
        request = settings.request()

        def done(name, error):
            settings.errors.clear()
            if error:
                settings.show_error(error)
            else:
                settings.picture = name

        service.call(lambda: pictures.draw(client, request), done)
        return {"CANCELLED"} if settings.errors else {"FINISHED"}


class SEEDMESH_UL_presets(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active, _name):
        row = layout.split(factor=0.7)
        row.operator("seedmesh.choose", text=item.title, emboss=False, icon_value=pictures.icon(item.name)).preset = item.name
        row.label(text=item.generator)


class SEEDMESH_OT_choose(bpy.types.Operator):
    """Selects this preset"""
    bl_idname = "seedmesh.choose"
    bl_label = "Choose"
    preset: bpy.props.StringProperty()

    def execute(self, context):
        settings = context.scene.seedmesh
        settings.preset = self.preset
        settings.preset_index = max(settings.presets.find(self.preset), 0)
        settings.parameters.clear()
        settings.picture = ""
        return {"FINISHED"}


classes = (SEEDMESH_OT_gallery, SEEDMESH_OT_parameters, SEEDMESH_OT_choose, SEEDMESH_OT_picture, SEEDMESH_UL_presets)
