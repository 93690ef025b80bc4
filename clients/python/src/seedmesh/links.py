"""Addresses that are made without a server: permalinks, presets, signatures."""
import base64
import hashlib
import hmac
import urllib.parse
import zlib
from typing import Any, Dict, Mapping, Optional, Union

from .files import text_of
from .types import Request

longest_link = 8000  # characters that the server takes
extensions: Dict[str, str] = {"png16": "png", "png8": "png", "rgb24": "png", "rgba32": "png", "placements": "zip"}


def token_of(request: Request) -> str:
    """The request as base64url of raw deflate."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(text_of(request)) + packer.flush()
    return base64.urlsafe_b64encode(packed).decode().rstrip("=")


def extension_of(request: Mapping[str, Any]) -> str:
    """The extension of the format that the request names."""
    name = str(request.get("output", {}).get("format", "glb"))
    return extensions.get(name, name)


def permalink_path(request: Request, extension: Optional[str] = None) -> str:
    """Path of a link that contains the request. ValueError if no server would take it."""
    path = f"/v1/models/{token_of(request)}.{extension or extension_of(request)}"
    if len(path) > longest_link:
        raise ValueError(f"the link has {len(path)} characters, expected at most {longest_link}")
    return path


def thumbnail_path(name: str) -> str:
    return f"/thumbnails/{urllib.parse.quote(name, safe='')}.webp"


def picture_path(request: Request, size: Union[int, str] = 512, view: str = "three_quarter") -> str:
    """Path of a picture of the model. `size`: pixels a side, or "640x360". `view`: a name, or azimuth and elevation in degrees, as "35,18"."""
    return permalink_path(request, "webp") + "?" + urllib.parse.urlencode({"size": size, "view": view})


def preset_path(name: str, extension: str = "glb", query: Optional[Mapping[str, Union[str, int, float, bool]]] = None) -> str:
    """Path of a preset's model. `query`: seed, output.x, a parameter's name, or constants.x."""
    path = f"/v1/presets/{urllib.parse.quote(name, safe='')}.{extension}"
    values = {key: str(value).lower() if isinstance(value, bool) else value for key, value in (query or {}).items()}
    return path + ("?" + urllib.parse.urlencode(values) if values else "")


def sign(path: str, key: str, secret: bytes, expires: Optional[int] = None) -> str:
    """The path with a signature, for a server with signing keys. `expires`: seconds since 1970."""
    covered = path + ("&" if "?" in path else "?")
    covered += (f"expires={expires}&" if expires is not None else "") + f"key={key}"
    digest = hmac.new(secret, covered.encode(), hashlib.sha256).digest()
    return f"{covered}&signature={base64.urlsafe_b64encode(digest).decode().rstrip('=')}"
