"""`sync`: makes the models of all request files below a directory, and only those that changed.

`seedmesh.lock` in that directory has, for each request file, its hash, and for each file made: engine, size, ETag and hash. It
belongs under version control. Nothing is sent for an entry whose request file, engine and output are as the lock says. The program
`seedmesh sync` reads and writes the same file.
"""
import json
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Optional, Set, Tuple, Union

from .client import Client
from .errors import SeedmeshError
from .files import part_suffix, sha256, sha256_of_file, write_whole
from .request_file import RequestFile, Unreadable, error_lines, read_request_file, suffix

lock_name = "seedmesh.lock"
Entry = Dict[str, Any]  # {"request": sha256 of the file, "outputs": {name: {"bytes", "engine", "etag", "sha256"}}}


@dataclass
class Report:
    """Lines to print, and counts. `status` is that of the program."""
    lines: List[str] = field(default_factory=list)
    made: int = 0
    same: int = 0
    changed: int = 0
    refused: int = 0

    @property
    def status(self) -> int:
        return 1 if self.refused or self.changed else 0


@dataclass
class _Task:
    file: RequestFile
    key: str
    digest: str
    output: str
    known: Optional[Dict[str, Any]]  # what the lock has of this output


class Sync:
    def __init__(self, directory: str, client: Optional[Client], jobs: int = 4):
        """Without a client, `check` compares with the lock alone."""
        self.directory = directory
        self.client = client
        self.jobs = jobs
        self.report = Report()
        self.lock = self._read_lock()

    def run(self) -> Report:
        """Makes what changed. OSError if something has to be made and there is no server."""
        self._remove_parts()
        tasks, found = self._tasks(is_thorough=False)
        engine = self._engine(is_needed=bool(tasks))
        tasks += self._outdated(engine, found, {(task.key, task.output) for task in tasks})
        try:
            with ThreadPoolExecutor(self.jobs) as pool:
                for task, answer in zip(tasks, pool.map(lambda task: self._make(task, engine), tasks)):
                    self._store(task, answer)
        finally:
            self._forget(found)
            self._mark_incomplete(found)
            self._write_lock()
        return self.report

    def check(self) -> Report:
        """Compares every byte, writes nothing. Counts as `changed` what run() would make or remove."""
        tasks, found = self._tasks(is_thorough=True)
        engine = self.client.engine() if self.client else None
        tasks += self._outdated(engine, found, {(task.key, task.output) for task in tasks})
        for task in tasks:
            self.report.changed += 1
            self.report.lines.append(f"changed {os.path.join(os.path.dirname(task.key), task.output)}")
        for key, name in self._surplus(found):
            self.report.changed += 1
            self.report.lines.append(f"surplus {os.path.join(os.path.dirname(key), name)}")
        return self.report

    def outputs(self) -> List[str]:
        """The files that run() makes, as paths; request files that cannot be read are left to run()."""
        return [os.path.join(self.directory, os.path.dirname(key), name)
                for key, file, _ in self._files() for name in file.outputs]

    def _engine(self, is_needed: bool) -> Optional[str]:
        assert self.client
        try:
            return self.client.engine()
        except OSError as error:
            if is_needed:
                raise
            self.report.lines.append(f"note: no server at {self.client.url}, so its engine is not compared ({error})")
            return None

    def _request_paths(self) -> Iterator[str]:
        for folder, folders, names in os.walk(self.directory):
            folders[:] = sorted(name for name in folders if not name.startswith("."))
            for name in sorted(names):
                if name.endswith(suffix) and not name.startswith("."):
                    yield os.path.join(folder, name)

    def _key(self, path: str) -> str:
        return os.path.relpath(path, self.directory).replace(os.sep, "/")

    def _files(self) -> Iterator[Tuple[str, RequestFile, str]]:
        """Key, content and hash of each request file. Files that cannot be read go to the report."""
        for path in self._request_paths():
            with open(path, "rb") as opened:
                data = opened.read()
            key, digest = self._key(path), sha256(data)
            known = self.lock.get(key)
            if known and known["request"] == digest:
                yield key, RequestFile(path, "", {name: {"preset": ""} for name in known["outputs"]}), digest
                continue
            try:
                yield key, read_request_file(path, data.decode()), digest
            except (Unreadable, UnicodeDecodeError) as error:
                self._refuse([str(error) if isinstance(error, Unreadable) else f"{path}:1:1: found bytes that are not UTF-8"])

    def _tasks(self, is_thorough: bool) -> Tuple[List[_Task], Dict[str, Tuple[RequestFile, str]]]:
        """What has to be made, and all request files. Thorough: compares the bytes of outputs, not only their size."""
        tasks: List[_Task] = []
        found: Dict[str, Tuple[RequestFile, str]] = {}
        owners: Dict[str, str] = {}
        for key, file, digest in self._files():
            folder = os.path.dirname(file.path)
            found[key] = (file, digest)
            for name in file.outputs:
                path = os.path.join(folder, name)
                if owners.setdefault(path, file.path) != file.path:
                    self._refuse([f"{file.path}:1:1: makes {name}, which {owners[path]} makes, too"])
                elif self._is_current(key, digest, name, path, is_thorough):
                    self.report.same += 1
                else:
                    tasks.append(_Task(file, key, digest, name, self.lock.get(key, {"outputs": {}})["outputs"].get(name)))
        return tasks, found

    def _is_current(self, key: str, digest: str, name: str, path: str, is_thorough: bool) -> bool:
        entry = self.lock.get(key)
        made = entry["outputs"].get(name) if entry and entry["request"] == digest else None
        try:
            if not made or os.stat(path).st_size != made["bytes"]:
                return False
            return not is_thorough or sha256_of_file(path) == made["sha256"]
        except FileNotFoundError:
            return False

    def _outdated(self, engine: Optional[str], found: Dict[str, Tuple[RequestFile, str]], busy: Set[Tuple[str, str]]) -> List[_Task]:
        """Outputs that another engine made."""
        if engine is None:
            return []
        tasks = []
        for key, (file, digest) in found.items():
            entry = self.lock.get(key)
            if not entry or entry["request"] != digest:
                continue
            for name, made in entry["outputs"].items():
                if made["engine"] != engine and (key, name) not in busy:
                    tasks.append(_Task(file, key, digest, name, made))
                    self.report.same -= 1
        return tasks

    def _make(self, task: _Task, engine: Optional[str]) -> Union[Dict[str, Any], List[str]]:
        """Writes the file; gives its entry of the lock, or the lines of a refusal."""
        assert self.client
        file = task.file
        if not file.text:  # known by its hash, and not parsed yet
            with open(file.path, encoding="utf-8") as opened:
                file = read_request_file(file.path, opened.read())
        path = os.path.join(os.path.dirname(file.path), task.output)
        try:
            model = self.client.generate_if_changed(file.outputs[task.output], self._etag_of(task, engine, path))
        except SeedmeshError as error:
            return error_lines(file, task.output, error)
        if model is None:
            assert task.known
            return task.known
        model.save(path)
        entry = {"bytes": len(model.data), "engine": engine, "sha256": sha256(model.data)}
        return {**entry, "etag": model.etag} if model.etag else entry

    @staticmethod
    def _etag_of(task: _Task, engine: Optional[str], path: str) -> Optional[str]:
        """The ETag of the file, if it is as this engine made it."""
        known = task.known
        if not known or known["engine"] != engine or not os.path.exists(path) or sha256_of_file(path) != known["sha256"]:
            return None
        etag: Optional[str] = known.get("etag")
        return etag

    def _store(self, task: _Task, answer: Union[Dict[str, Any], List[str]]) -> None:
        if isinstance(answer, list):
            self._refuse(answer)
            return
        entry = self.lock.get(task.key)
        if not entry or entry["request"] != task.digest:
            old = entry["outputs"] if entry else {}
            surplus = {name: made for name, made in old.items() if name not in task.file.outputs}
            self._remove(task.key, surplus)
            entry = self.lock[task.key] = {"request": task.digest, "outputs": {}}
        entry["outputs"][task.output] = answer
        if answer is task.known:
            self.report.same += 1
            return
        self.report.made += 1
        self.report.lines.append(f"made {os.path.join(os.path.dirname(task.key), task.output)}")

    def _refuse(self, lines: List[str]) -> None:
        self.report.refused += 1
        self.report.lines += [f"refused {line}" for line in lines]

    def _surplus(self, found: Dict[str, Tuple[RequestFile, str]]) -> List[Tuple[str, str]]:
        """Outputs of the lock that no request file makes any more."""
        made = {(os.path.dirname(key), name) for key, (file, _) in found.items() for name in file.outputs}
        return [(key, name) for key, entry in self.lock.items() for name in entry["outputs"]
                if (os.path.dirname(key), name) not in made and (key in found or not os.path.exists(os.path.join(self.directory, key)))]

    def _forget(self, found: Dict[str, Tuple[RequestFile, str]]) -> None:
        for key, name in self._surplus(found):
            self._remove(key, {name: self.lock[key]["outputs"].pop(name)})
        for key in [key for key in self.lock if not os.path.exists(os.path.join(self.directory, key))]:
            del self.lock[key]

    def _mark_incomplete(self, found: Dict[str, Tuple[RequestFile, str]]) -> None:
        """An entry without all outputs of its request file has no hash, so that the next run reads the file again."""
        for key, entry in self.lock.items():
            if key in found and set(entry["outputs"]) != set(found[key][0].outputs):
                entry["request"] = ""

    def _remove(self, key: str, outputs: Dict[str, Any]) -> None:
        """Removes outputs that are as they were made; others are somebody's work and stay."""
        for name, made in outputs.items():
            path = os.path.join(self.directory, os.path.dirname(key), name)
            if os.path.exists(path) and sha256_of_file(path) == made["sha256"]:
                os.remove(path)
                self.report.lines.append(f"removed {os.path.join(os.path.dirname(key), name)}")

    def _remove_parts(self) -> None:
        """What an interrupted run left. Runs on one directory at the same time are not supported."""
        for folder, _, names in os.walk(self.directory):
            for name in names:
                if name.endswith(part_suffix):
                    os.remove(os.path.join(folder, name))

    def _read_lock(self) -> Dict[str, Entry]:
        path = os.path.join(self.directory, lock_name)
        try:
            with open(path, encoding="utf-8") as file:
                files: Dict[str, Entry] = json.load(file)["files"]
        except FileNotFoundError:
            return {}
        except (ValueError, KeyError, TypeError):
            raise Unreadable(f"{path}:1:1: is no lock file; remove it to make all models again") from None
        return files

    def _write_lock(self) -> None:
        """One line for each request file, so that branches merge."""
        lines = [f"  {json.dumps(key)}: {json.dumps(self.lock[key], sort_keys=True)}" for key in sorted(self.lock)]
        text = '{\n "files": {\n' + ",\n".join(lines) + "\n }\n}\n"
        path = os.path.join(self.directory, lock_name)
        if not os.path.exists(path) or sha256_of_file(path) != sha256(text.encode()):
            write_whole(path, text.encode())
