"""Files that are whole or not there, and the hashes of requests and bytes."""
import hashlib
import json
import os
from typing import Any

part_suffix = ".seedmesh-part"


def write_whole(path: str, data: bytes) -> None:
    """Replaces the file in one step: a reader finds the old bytes or the new ones."""
    part = f"{path}.{os.getpid()}{part_suffix}"
    try:
        with open(part, "wb") as file:
            file.write(data)
        os.replace(part, path)
    except BaseException:
        if os.path.exists(part):
            os.remove(part)
        raise


def sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def sha256_of_file(path: str) -> str:
    with open(path, "rb") as file:
        return sha256(file.read())


def text_of(request: Any) -> bytes:
    """A request as JSON in UTF-8 with sorted keys. ValueError for a number that JSON cannot hold."""
    return json.dumps(request, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()
