"""One call over HTTP: redirects inside one server, retries by Retry-After, problems as exceptions."""
import json
import time
import urllib.error
import urllib.parse
import urllib.request
from dataclasses import dataclass
from email.message import Message
from typing import IO, Any, Dict, Optional

from .errors import Busy, Refused, SeedmeshError

shortest_wait = 0.1  # seconds, for a server that says Retry-After: 0
repeated = (429, 503)


@dataclass(frozen=True)
class Answer:
    status: int
    headers: Message
    data: bytes

    def json(self) -> Any:
        return json.loads(self.data)

    def header(self, name: str) -> Optional[str]:
        return self.headers.get(name)


class _SameServer(urllib.request.HTTPRedirectHandler):
    """Follows no redirect to another server, which would receive the key."""

    def redirect_request(self, req: urllib.request.Request, fp: IO[bytes], code: int, msg: str, headers: Any,
                         newurl: str) -> Optional[urllib.request.Request]:
        if urllib.parse.urlsplit(newurl)[:2] != urllib.parse.urlsplit(req.full_url)[:2]:
            raise OSError(f"{req.full_url} redirects to another server: {newurl}")
        return super().redirect_request(req, fp, code, msg, headers, newurl)


class Transport:
    """`patience`: seconds that a call waits for a busy server. `timeout`: seconds without a byte of an answer."""

    def __init__(self, url: str, key: Optional[str], patience: float, timeout: float):
        parts = urllib.parse.urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.netloc:
            raise ValueError(f"found {url!r} as the server, expected an address like http://127.0.0.1:8080")
        self.url = url.rstrip("/")
        self.key = key
        self.patience = patience
        self.timeout = timeout
        self._opener = urllib.request.build_opener(_SameServer())

    def call(self, target: str, body: Optional[bytes] = None, headers: Optional[Dict[str, str]] = None) -> Answer:
        """GET, or POST if there is a body. The status of the answer is 200 or 304; any other is raised."""
        fields = dict(headers or {})
        if body is not None:
            fields["Content-Type"] = "application/json"
        if self.key:
            fields["Authorization"] = f"Bearer {self.key}"
        end = time.monotonic() + self.patience
        while True:
            request = urllib.request.Request(self.url + target, body, fields)
            try:
                with self._opener.open(request, timeout=self.timeout) as answer:
                    return Answer(answer.status, answer.headers, answer.read())
            except urllib.error.HTTPError as error:
                with error:
                    if error.code == 304:
                        return Answer(304, error.headers, b"")
                    wait = _wait_of(error)
                    if wait is None or time.monotonic() + wait > end:
                        raise _exception_of(error) from None
            time.sleep(wait)


def _wait_of(error: urllib.error.HTTPError) -> Optional[float]:
    """Seconds until the same call is worth repeating, or None."""
    value = error.headers.get("Retry-After", "")
    if error.code not in repeated or not value.isdecimal():
        return None
    return max(float(value), shortest_wait)


def _exception_of(error: urllib.error.HTTPError) -> SeedmeshError:
    try:
        problem = json.load(error) if error.headers.get_content_type() == "application/problem+json" else None
    except ValueError:
        problem = None
    if problem is None:
        problem = {"type": "about:blank", "title": str(error.reason), "status": error.code, "detail": f"HTTP status {error.code}"}
    return (Busy if error.code in repeated else Refused)(problem)
