#!/usr/bin/env python3
"""Models from a Seedmesh server, with nothing but Python's standard library (3.8 and later).

    python3 seedmesh.py request.json oak.glb

or from a build script, Blender, Houdini or Unreal:

    import seedmesh
    seedmesh.fetch({"preset": "oak", "seed": 7}, "oak.glb")

The variables SEEDMESH_URL and SEEDMESH_KEY say where the server is and who asks. Beside each model stands what it was
made from: a model that has not changed is not sent again, unless its request is too long for a link. A server that is
busy is asked again after the time that it names.
"""
import json
import os
import sys
import time
import urllib.error
import urllib.request


class Refused(Exception):
    """The server's answer to a request that it does not take: `problem` as RFC 9457 has it."""

    def __init__(self, problem):
        self.problem = problem
        faults = problem.get("errors", [])
        super().__init__("\n".join(map(_line, faults)) or problem.get("detail", "refused"))


def _line(fault):
    place = f":{fault['line']}:{fault['column']}" if "line" in fault else ""
    return f"{fault['pointer']}{place}: {fault['message']}"


def fetch(request, path, url=None, key=None, patience=60):
    """Makes the model of `request` and keeps it in the file `path`. True: it was sent, and may be another than before.

    Raises Refused, with all faults of the request; OSError where there is no server, or none that has time within
    `patience` seconds.
    """
    url = url or os.environ.get("SEEDMESH_URL", "http://127.0.0.1:8080")
    key = key or os.environ.get("SEEDMESH_KEY")
    text = json.dumps(request, sort_keys=True)
    made = _made_before(path, text)
    if made.get("link"):
        call = urllib.request.Request(url + made["link"], headers={"If-None-Match": made["tag"]})
    else:
        call = urllib.request.Request(url + "/v1/generate", text.encode(), {"Content-Type": "application/json"})
    if key:
        call.add_header("Authorization", "Bearer " + key)
    end = time.monotonic() + patience
    while True:
        try:
            with urllib.request.urlopen(call, timeout=patience) as answer:
                _keep(path, answer.read())
                made = {"request": text, "link": answer.headers["Content-Location"], "tag": answer.headers["ETag"]}
                _keep(path + ".made", json.dumps(made).encode())
                return True
        except urllib.error.HTTPError as answer:
            if answer.code == 304:
                return False
            wait = int(answer.headers.get("Retry-After", 0))
            if answer.code in (429, 503) and wait and time.monotonic() + wait < end:
                time.sleep(wait)
                continue
            if answer.headers.get_content_type() == "application/problem+json":
                raise Refused(json.load(answer)) from None
            raise


def _made_before(path, text):
    """How the file was made, if it was made from the same request."""
    if not os.path.exists(path) or not os.path.exists(path + ".made"):
        return {}
    with open(path + ".made", encoding="utf-8") as file:
        made = json.load(file)
    return made if made["request"] == text else {}


def _keep(path, data):
    """Whole or not at all: nobody reads half a model."""
    with open(path + ".part", "wb") as file:
        file.write(data)
    os.replace(path + ".part", path)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as text:
        try:
            fetch(json.load(text), sys.argv[2])
        except Refused as refused:
            raise SystemExit(str(refused)) from None
