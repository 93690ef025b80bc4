"""Request files: `oak.seedmesh` has a request as JSON, and optionally `$schema`, `name` and `outputs`."""
import json
import os
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, cast

from .errors import SeedmeshError
from .links import extension_of
from .positions import Positions, parse, token_of
from .types import Request

suffix = ".seedmesh"
formats = ("glb", "gltf", "zip", "png16", "png8", "rgb24", "rgba32", "r16", "ply", "placements", "geojson")  # a server may have others
own_members = ("$schema", "name", "outputs")


@dataclass(frozen=True)
class RequestFile:
    """`outputs`: the request of each file that is made, by the name of that file, which stands beside the request file."""
    path: str
    text: str
    outputs: Dict[str, Request]


class Unreadable(Exception):
    """The file has no request. The text has path, line and column."""


def _refusal(path: str, text: str, pointer: str, message: str) -> Unreadable:
    line, column = Positions(text).of(pointer)
    return Unreadable(f"{path}:{line}:{column}: {pointer}: {message}")


def read_request_file(path: str, text: str) -> RequestFile:
    """Splits a request file into one request for each output. Whether these are valid is for the server to say."""
    try:
        value = parse(text)
    except json.JSONDecodeError as error:
        raise Unreadable(f"{path}:{error.lineno}:{error.colno}: {error.msg}") from None
    except ValueError as error:
        raise Unreadable(f"{path}:1:1: {error}") from None
    if not isinstance(value, dict):
        raise _refusal(path, text, "", "expected an object")
    request = {key: each for key, each in value.items() if key not in own_members}
    base = os.path.basename(path)
    name = value.get("name", base[:-len(suffix)] if base.endswith(suffix) else os.path.splitext(base)[0])
    if not isinstance(name, str) or not _is_file_name(name):
        raise _refusal(path, text, "/name", "expected the name of a file, without a directory")
    if not isinstance(request.get("output", {}), dict):
        raise _refusal(path, text, "/output", "expected an object")
    given = value.get("outputs")
    if given is None:
        return RequestFile(path, text, {f"{name}.{extension_of(request)}": cast(Request, request)})
    if not isinstance(given, dict) or not given:
        raise _refusal(path, text, "/outputs", "expected an object of file names, at least one")
    outputs: Dict[str, Request] = {}
    for file, changes in given.items():
        pointer = "/outputs/" + token_of(file)
        if not _is_file_name(file) or file.endswith(suffix):
            raise _refusal(path, text, pointer, "expected the name of a file, without a directory")
        if not isinstance(changes, dict):
            raise _refusal(path, text, pointer, "expected an object with members of output")
        merged = {key: each for key, each in {**request.get("output", {}), **changes}.items() if each is not None}
        format_name = merged.get("format", "glb")
        if format_name in formats and not file.endswith("." + extension_of({"output": merged})):
            raise _refusal(path, text, pointer, f"expected the extension .{extension_of({'output': merged})} of the format {format_name}")
        outputs[file] = cast(Request, {**request, "output": merged})
    return RequestFile(path, text, outputs)


def _is_file_name(name: str) -> bool:
    return bool(name) and name[0] != "." and name == os.path.basename(name) and not any(sign in '\\:*?"<>|' or sign < " " for sign in name)


def error_lines(file: RequestFile, output: Optional[str], error: SeedmeshError) -> List[str]:
    """A refusal as lines with path, line and column of the value in the request file."""
    positions = Positions(file.text)
    lines = []
    for each in error.errors:
        pointer = each["pointer"]
        if output and pointer.startswith("/output/"):
            changed = "/outputs/" + token_of(output) + pointer[len("/output"):]
            pointer = changed if changed in positions.starts else pointer
        line, column = positions.of(pointer)
        inner = f" (line {each['line']}, column {each['column']} of this text)" if "line" in each and "column" in each else ""
        lines.append(f"{file.path}:{line}:{column}: {pointer}: {each['message']}{inner}")
    return lines or [f"{file.path}:1:1: {error}"]


def request_of(value: Any) -> Request:
    """The request of a request file without its own members."""
    return cast(Request, {key: each for key, each in value.items() if key not in own_members})
