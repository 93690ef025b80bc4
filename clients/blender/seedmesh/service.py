# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls of the server outside Blender's main thread, which alone may touch bpy."""
import threading

import bpy

from .client import Client


def is_allowed():
    """False if the user of Blender 4.2 or later has switched off online access."""
    return getattr(bpy.app, "online_access", True)


def client():
    preferences = bpy.context.preferences.addons[__package__].preferences
    return Client(preferences.url, preferences.key or None)


def call(work, done):
    """Runs `work` in a thread, then `done(result, error)` in the main thread. Without a window both run at once."""
    answer = {}

    def run():
        try:
            answer["result"] = work()
        except Exception as error:  # whatever it is, the user sees it
            answer["error"] = error

    if bpy.app.background:
        run()
        done(answer.get("result"), answer.get("error"))
        return
    thread = threading.Thread(target=run, daemon=True)
    thread.start()

    def poll():
        if thread.is_alive():
            return 0.1
        done(answer.get("result"), answer.get("error"))
        return None

    bpy.app.timers.register(poll, first_interval=0.1)
