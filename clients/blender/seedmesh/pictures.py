# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as icons: those of the gallery, and those of models that the service draws. Each is fetched once in a session."""
import hashlib
import json
import os
import tempfile
from concurrent.futures import ThreadPoolExecutor

import bpy
import bpy.utils.previews

from .client import SeedmeshError

_state = {}
classes = ()


def register():
    _state["folder"] = tempfile.TemporaryDirectory()
    _state["icons"] = bpy.utils.previews.new()


def unregister():
    bpy.utils.previews.remove(_state.pop("icons"))
    _state.pop("folder").cleanup()


def path(name):
    return os.path.join(_state["folder"].name, name + ".webp")


def fetch(client, names):
    """Saves pictures; runs outside the main thread. A preset without a picture is left out."""
    def save(name):
        try:
            data = client.thumbnail(name)
        except (OSError, SeedmeshError):
            return
        with open(path(name), "wb") as file:
            file.write(data)

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(save, [name for name in names if not os.path.exists(path(name))]))


def draw(client, request):
    """Saves the picture of a model, and returns its name; runs outside the main thread."""
    name = "request_" + hashlib.sha256(json.dumps(request, sort_keys=True).encode()).hexdigest()[:16]
    if not os.path.exists(path(name)):
        data = client.picture(request, size=256)
        with open(path(name), "wb") as file:
            file.write(data)
    return name


def icon(name):
    """The number of the icon of a preset; 0 for none, and without a window."""
    icons = _state["icons"]
    if name not in icons:
        if not os.path.exists(path(name)):
            return 0
        icons.load(name, path(name), "IMAGE")
    return icons[name].icon_id
