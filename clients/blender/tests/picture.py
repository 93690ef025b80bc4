# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the panel beside a grown model, for the docs. Needs a window:
   xvfb-run -s "-screen 0 1280x800x24" blender --factory-startup --python picture.py -- ADDON.zip URL FILE.png"""
import subprocess
import sys

import bpy

archive, url, target = sys.argv[sys.argv.index("--") + 1:]


def install():
    if bpy.app.version < (4, 2):
        bpy.ops.preferences.addon_install(filepath=archive)
        name = "seedmesh"
    else:
        bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default")
        name = "bl_ext.user_default.seedmesh"
    bpy.ops.preferences.addon_enable(module=name)
    bpy.context.preferences.addons[name].preferences.url = url
    bpy.context.preferences.view.show_splash = False


def in_view(act):
    """Calls act(area, region of the sidebar) inside the 3D viewport."""
    window = bpy.context.window_manager.windows[0]
    area = next(each for each in window.screen.areas if each.type == "VIEW_3D")
    sidebar = next(each for each in area.regions if each.type == "UI")
    drawing = next(each for each in area.regions if each.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=drawing):
        return act(area, sidebar)


def start(area, _sidebar):
    area.spaces.active.show_region_ui = True
    for name in ("Cube", "Light", "Camera"):
        bpy.data.objects.remove(bpy.data.objects[name])
    bpy.ops.seedmesh.gallery()


def grow(_area, _sidebar):
    bpy.ops.seedmesh.choose(preset="oak")
    bpy.ops.seedmesh.grow(seed=3)


def frame(area, sidebar):
    sidebar.active_panel_category = "Seedmesh"
    area.spaces.active.shading.type = "MATERIAL"
    bpy.ops.view3d.view_all()
    for each in bpy.data.objects:
        each.select_set(False)


def save(_area, _sidebar):
    subprocess.run(["import", "-window", "root", target], check=True)  # of ImageMagick; Blender's own picture is black without a desktop


steps = [(4, start), (12, grow), (10, frame), (75, save), (2, lambda *_: bpy.ops.wm.quit_blender())]


def step():
    """One step, then the time until the next."""
    settings = bpy.context.scene.seedmesh
    if settings.is_busy:
        return 1
    _, act = steps.pop(0)
    in_view(act)
    return steps[0][0] if steps else None


install()
bpy.app.timers.register(step, first_interval=steps[0][0])
