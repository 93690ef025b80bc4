# SPDX-License-Identifier: GPL-3.0-or-later
"""Seedmesh for Blender 3.4 to 5: grow models of a Seedmesh server, and grow them again with another seed."""
import bpy

from . import gallery, grow, panel, pictures, properties, scatter

bl_info = {
    "name": "Seedmesh",
    "author": "Seedmesh contributors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Seedmesh",
    "description": "Grow seeded trees, buildings, terrain and scenes",
    "category": "Import-Export",
}


class SeedmeshPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    url: bpy.props.StringProperty(name="Server", default="http://127.0.0.1:8080", description="Address of the Seedmesh server")
    key: bpy.props.StringProperty(name="Key", subtype="PASSWORD", description="API key, if the server requires one")

    def draw(self, _context):
        self.layout.prop(self, "url")
        self.layout.prop(self, "key")


parts = (properties, gallery, grow, scatter, panel)


def register():
    bpy.utils.register_class(SeedmeshPreferences)
    for part in parts:
        for each in part.classes:
            bpy.utils.register_class(each)
    pictures.register()
    bpy.types.Scene.seedmesh = bpy.props.PointerProperty(type=properties.SeedmeshSettings)


def unregister():
    del bpy.types.Scene.seedmesh
    pictures.unregister()
    for part in reversed(parts):
        for each in reversed(part.classes):
            bpy.utils.unregister_class(each)
    bpy.utils.unregister_class(SeedmeshPreferences)
