# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the sidebar of the 3D viewport."""
import bpy

from . import pictures, service


class SEEDMESH_PT_panel(bpy.types.Panel):
    bl_idname = "SEEDMESH_PT_panel"
    bl_label = "Seedmesh"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Seedmesh"

    def draw(self, context):
        layout, settings = self.layout, context.scene.seedmesh
        if not service.is_allowed():
            layout.label(text="Online access is off: Preferences > System", icon="ERROR")
        layout.operator("seedmesh.gallery", icon="FILE_REFRESH")
        if settings.presets:
            layout.template_list("SEEDMESH_UL_presets", "", settings, "presets", settings, "preset_index")
        picture = pictures.icon(settings.picture) or pictures.icon(settings.preset)
        if picture:
            layout.template_icon(picture, scale=7)
        self.field(layout, settings, "preset", "/preset")
        self.field(layout, settings, "seed", "/seed")
        self.field(layout, settings, "lods", "/output/lods")
        self.field(layout, settings, "collision", "/output/collision")
        self.field(layout, settings, "animation", "/output/animation")
        layout.operator("seedmesh.parameters", icon="PREFERENCES")
        self.draw_parameters(layout, settings)
        layout.operator("seedmesh.picture", icon="IMAGE_DATA")
        row = layout.row()
        row.enabled = not settings.is_busy
        row.operator("seedmesh.grow", icon="OUTLINER_OB_MESH")
        row.operator("seedmesh.regrow", icon="FILE_REFRESH")
        layout.prop(settings, "count")
        layout.operator("seedmesh.scatter", icon="PARTICLES")
        shown = {"/preset", "/seed", "/output/lods", "/output/collision", "/output/animation"}
        shown |= {"/parameters/" + each.name for each in settings.parameters}
        for error in settings.errors:
            if error.pointer not in shown:
                layout.label(text=f"{error.pointer} {error.message}".strip(), icon="ERROR")

    def field(self, layout, owner, name, pointer, settings=None, text=None):
        """A property, and below it the errors of its pointer."""
        errors = [each.message for each in (settings or owner).errors if each.pointer == pointer]
        row = layout.row()
        row.alert = bool(errors)
        row.prop(owner, name, **({"text": text} if text is not None else {}))
        for message in errors:
            layout.label(text=message, icon="ERROR")
        return row

    def draw_parameters(self, layout, settings):
        group = None
        for each in settings.parameters:
            if each.group != group:
                group = each.group
                layout.label(text=group)
            row = layout.row()
            row.prop(each, "is_given", text="")
            column = row.column()
            column.active = each.is_given
            self.field(column, each, "value_" + each.kind, "/parameters/" + each.name, settings, each.title)


classes = (SEEDMESH_PT_panel,)
