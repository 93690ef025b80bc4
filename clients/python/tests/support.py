"""The server that the tests talk to: SEEDMESH_URL, or one of the program SEEDMESH_PROGRAM for the whole run."""
import atexit
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Optional

root = Path(__file__).resolve().parents[3]
program = os.environ.get("SEEDMESH_PROGRAM", str(root / "build/release/seedmesh"))
_url: Optional[str] = None


def server_url() -> str:
    global _url
    if _url is None:
        process = subprocess.Popen([program, "serve", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        atexit.register(lambda: (process.terminate(), process.wait()))
        for line in process.stdout:
            found = re.match(r"Listening on (\S+)$", line)
            if found:
                _url = found.group(1)
                break
        assert _url, "the server did not start"
    return _url


class InFolder(unittest.TestCase):
    """A test with an empty directory."""

    def setUp(self) -> None:
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = Path(self._folder.name)

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def names(self) -> list:
        return sorted(path.relative_to(self.folder).as_posix() for path in self.folder.rglob("*") if path.is_file())
