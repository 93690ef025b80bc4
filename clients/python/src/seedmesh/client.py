"""Client, and AsyncClient with the same methods in a thread each."""
import asyncio
import json
import os
from dataclasses import asdict, dataclass
from typing import Any, Dict, List, Mapping, Optional, Union, cast, overload

from . import links
from .files import sha256, sha256_of_file, text_of, write_whole
from .transport import Answer, Transport
from .types import (BuildingDerivation, BuildingRequest, CityDerivation, CityRequest, FractalDerivation, FractalRequest, LsystemDerivation, LsystemRequest,
                    PresetListPresetsItem, Request, SceneDerivation, SceneRequest, TerrainDerivation, TerrainRequest,
                    TreeDerivation, TreeRequest, Validation)

default_url = "http://127.0.0.1:8080"
Override = Union[str, int, float, bool]


@dataclass(frozen=True)
class Model:
    """A file that the server made. `link`: path of its permalink, or None if it would be too long."""
    data: bytes
    media_type: str
    etag: str
    link: Optional[str]
    triangles: int
    vertices: int
    warnings: int

    def save(self, path: str) -> None:
        """Writes the file whole or not at all."""
        write_whole(path, self.data)


def _model_of(answer: Answer) -> Model:
    def count(name: str) -> int:
        return int(answer.header(name) or 0)
    return Model(answer.data, answer.headers.get_content_type(), answer.header("ETag") or "", answer.header("Content-Location"),
                 count("Seedmesh-Triangles"), count("Seedmesh-Vertices"), count("Seedmesh-Warnings"))


class Client:
    """A server, from SEEDMESH_URL and SEEDMESH_KEY unless given.

    `patience`: seconds to wait while the server is busy. `timeout`: seconds without a byte of an answer. `cache`: a directory
    that keeps models; a model that has not changed is not sent again. Methods raise Refused, Busy, or OSError without a server.
    """

    def __init__(self, url: Optional[str] = None, key: Optional[str] = None, *, patience: float = 60, timeout: float = 120,
                 cache: Optional[str] = None):
        self._transport = Transport(url or os.environ.get("SEEDMESH_URL") or default_url, key or os.environ.get("SEEDMESH_KEY"),
                                    patience, timeout)
        self._cache = cache
        if cache:
            os.makedirs(cache, exist_ok=True)

    @property
    def url(self) -> str:
        return self._transport.url

    def engine(self) -> str:
        """The engine version: same engine and same request give the same bytes."""
        return str(self._transport.call("/version").json()["engine"])

    def presets(self, generator: Optional[str] = None) -> List[PresetListPresetsItem]:
        """The gallery: name, generator, title, description and tags of each preset."""
        answer: List[PresetListPresetsItem] = self._transport.call("/v1/presets").json()["presets"]
        return [each for each in answer if generator in (None, each["generator"])]

    def preset(self, name: str) -> Request:
        """The whole request of a preset."""
        return cast(Request, self._transport.call(links.preset_path(name, "json")).json())

    def thumbnail(self, name: str) -> bytes:
        """The gallery's picture of a preset: WebP, 192 by 144 pixels."""
        return self._transport.call(links.thumbnail_path(name)).data

    def picture(self, request: Request, size: Union[int, str] = 512, view: str = "three_quarter") -> bytes:
        """A picture of the model that the service draws, as WebP. `size`: pixels a side, or "640x360". ValueError if no link holds the request."""
        return self._transport.call(links.picture_path(request, size, view)).data

    def schema(self, generator: str) -> Dict[str, Any]:
        """The JSON Schema of a generator's parameters, or of request, output or problem."""
        return cast(Dict[str, Any], self._transport.call(f"/v1/schemas/{generator}").json())

    def validate(self, request: Request) -> Validation:
        """Warnings and an estimate of the size, without geometry."""
        return cast(Validation, self._post("/v1/validate", request).json())

    @overload
    def derive(self, request: BuildingRequest) -> BuildingDerivation: ...
    @overload
    def derive(self, request: CityRequest) -> CityDerivation: ...
    @overload
    def derive(self, request: FractalRequest) -> FractalDerivation: ...
    @overload
    def derive(self, request: LsystemRequest) -> LsystemDerivation: ...
    @overload
    def derive(self, request: SceneRequest) -> SceneDerivation: ...
    @overload
    def derive(self, request: TerrainRequest) -> TerrainDerivation: ...
    @overload
    def derive(self, request: TreeRequest) -> TreeDerivation: ...
    @overload
    def derive(self, request: Request) -> Any: ...

    def derive(self, request: Any) -> Any:
        """The generator's own result before geometry."""
        return self._post("/v1/derive", request).json()

    def generate(self, request: Request) -> Model:
        """The model. With a cache, a model that has not changed is read from there."""
        if not self._cache:
            return _model_of(self._post("/v1/generate", request))
        path = os.path.join(self._cache, sha256(self.url.encode() + b" " + text_of(request)))
        kept = _cached(path)
        answer = self._ask(request, kept.etag if kept else None)
        if answer.status == 304 and kept:
            return kept
        model = _model_of(answer)
        write_whole(path + ".bin", model.data)
        head = {**asdict(model), "data": sha256(model.data)}
        write_whole(path + ".json", json.dumps(head).encode())
        return model

    def generate_if_changed(self, request: Request, etag: Optional[str]) -> Optional[Model]:
        """The model, or None if its ETag is still this one."""
        answer = self._ask(request, etag)
        return None if answer.status == 304 else _model_of(answer)

    def fetch(self, request: Request, path: str) -> bool:
        """Keeps the model of `request` in the file `path`. True: it was sent, and may be another than before.

        `path` + ".lock" has the hashes of request and file and the ETag. A file that was changed by hand is replaced.
        """
        lock = path + ".lock"
        known = _read_json(lock)
        digest = sha256(text_of(request))
        is_known = (os.path.exists(path) and known.get("request_sha256") == digest
                    and known.get("bytes_sha256") == sha256_of_file(path))
        answer = self._ask(request, known["etag"] if is_known else None)
        if answer.status == 304:
            return False
        write_whole(path, answer.data)
        entry = {"request_sha256": digest, "etag": answer.header("ETag"), "link": answer.header("Content-Location"),
                 "bytes_sha256": sha256(answer.data)}
        write_whole(lock, (json.dumps(entry, indent=1) + "\n").encode())
        return True

    def permalink(self, request: Request, extension: Optional[str] = None) -> str:
        """A link that contains the whole request, made without the server. ValueError if the request is too long for one."""
        return self.url + links.permalink_path(request, extension)

    def preset_url(self, name: str, extension: str = "glb", query: Optional[Mapping[str, Override]] = None) -> str:
        """The link of a preset's model. `query` overrides: seed, output.x, a parameter's name, or constants.x."""
        return self.url + links.preset_path(name, extension, query)

    def sign(self, url: str, key: str, secret: bytes, expires: Optional[int] = None) -> str:
        """A link of this server with a signature, for clients without a key."""
        if not url.startswith(self.url + "/"):
            raise ValueError(f"found the link {url!r}, expected one of {self.url}")
        return self.url + links.sign(url[len(self.url):], key, secret, expires)

    def _post(self, target: str, request: Any) -> Answer:
        return self._transport.call(target, text_of(request))

    def _ask(self, request: Request, etag: Optional[str]) -> Answer:
        """The model by its permalink, or 304 if it still has this ETag. A request that is too long for a link is posted."""
        try:
            link = links.permalink_path(request)
        except ValueError:
            return self._post("/v1/generate", request)
        return self._transport.call(link, headers={"If-None-Match": etag} if etag else {})


def _read_json(path: str) -> Dict[str, Any]:
    try:
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
    except (FileNotFoundError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def _cached(path: str) -> Optional[Model]:
    head = _read_json(path + ".json")
    if not head or not os.path.exists(path + ".bin"):
        return None
    with open(path + ".bin", "rb") as file:
        data = file.read()
    if head.pop("data") != sha256(data):
        return None
    return Model(data, **head)


class AsyncClient:
    """The methods of Client for asyncio. Each call runs in a thread; a cancelled call ends in the background."""

    def __init__(self, url: Optional[str] = None, key: Optional[str] = None, *, patience: float = 60, timeout: float = 120,
                 cache: Optional[str] = None):
        self.client = Client(url, key, patience=patience, timeout=timeout, cache=cache)

    async def engine(self) -> str:
        return await asyncio.to_thread(self.client.engine)

    async def presets(self, generator: Optional[str] = None) -> List[PresetListPresetsItem]:
        return await asyncio.to_thread(self.client.presets, generator)

    async def preset(self, name: str) -> Request:
        return await asyncio.to_thread(self.client.preset, name)

    async def thumbnail(self, name: str) -> bytes:
        return await asyncio.to_thread(self.client.thumbnail, name)

    async def picture(self, request: Request, size: Union[int, str] = 512, view: str = "three_quarter") -> bytes:
        return await asyncio.to_thread(self.client.picture, request, size, view)

    async def schema(self, generator: str) -> Dict[str, Any]:
        return await asyncio.to_thread(self.client.schema, generator)

    async def validate(self, request: Request) -> Validation:
        return await asyncio.to_thread(self.client.validate, request)

    async def derive(self, request: Request) -> Any:
        untyped: Any = request
        return await asyncio.to_thread(lambda: self.client.derive(untyped))

    async def generate(self, request: Request) -> Model:
        return await asyncio.to_thread(self.client.generate, request)

    async def fetch(self, request: Request, path: str) -> bool:
        return await asyncio.to_thread(self.client.fetch, request, path)

    def permalink(self, request: Request, extension: Optional[str] = None) -> str:
        return self.client.permalink(request, extension)
