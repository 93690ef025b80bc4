"""python -m seedmesh: status 0, 1 (refused, or changed with --check), 2 (usage, or no server)."""
import argparse
import json
import os
import re
import subprocess
import sys
from contextlib import contextmanager
from typing import Iterator, List, Optional

from .client import Client
from .errors import SeedmeshError
from .request_file import RequestFile, Unreadable, error_lines, read_request_file
from .sync import Sync


@contextmanager
def _server_of(program: Optional[str]) -> Iterator[Optional[str]]:
    """The address of a server that runs while the block does, if a program is given."""
    if not program:
        yield None
        return
    with subprocess.Popen([program, "serve", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        try:
            assert process.stdout
            found = None
            for line in process.stdout:
                found = re.match(r"Listening on (\S+)$", line)
                if found:
                    break
            if not found:
                raise OSError(f"{program} serve ended before it listened")
            yield found.group(1)
        finally:
            process.terminate()


def _read(path: str) -> RequestFile:
    with open(path, encoding="utf-8") as file:
        return read_request_file(path, file.read())


def _sync(arguments: argparse.Namespace) -> int:
    if arguments.list:
        print("\n".join(Sync(arguments.directory, None).outputs()))
        return 0
    names_server = arguments.server or arguments.program or os.environ.get("SEEDMESH_URL")
    with _server_of(arguments.program) as url:
        client = Client(url or arguments.server, arguments.key) if names_server or not arguments.check else None
        sync = Sync(arguments.directory, client, arguments.jobs)
        try:
            report = sync.check() if arguments.check else sync.run()
        finally:
            print("".join(line + "\n" for line in sync.report.lines), end="")
    counts = f"{report.changed} changed" if arguments.check else f"{report.made} made"
    print(f"{counts}, {report.same} same, {report.refused} refused")
    return report.status


def _one(arguments: argparse.Namespace) -> int:
    """A command that takes one request file."""
    file = _read(arguments.file)
    name, request = next(iter(file.outputs.items()))
    with _server_of(arguments.program) as url:
        client = Client(url or arguments.server, arguments.key)
        try:
            if arguments.command == "generate":
                path = arguments.output or os.path.join(os.path.dirname(arguments.file), name)
                print(f"{'made' if client.fetch(request, path) else 'same'} {path}")
            elif arguments.command == "permalink":
                print(client.permalink(request))
            else:
                print(json.dumps(client.validate(request) if arguments.command == "validate" else client.derive(request), indent=1))
        except SeedmeshError as error:
            print("\n".join(error_lines(file, None, error)), file=sys.stderr)
            return 1
    return 0


def _presets(arguments: argparse.Namespace) -> int:
    with _server_of(arguments.program) as url:
        for each in Client(url or arguments.server, arguments.key).presets():
            print(f"{each['name']}\t{each['generator']}\t{each['title']}")
    return 0


def _parser() -> argparse.ArgumentParser:
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--server", metavar="URL", help="default: SEEDMESH_URL, or http://127.0.0.1:8080")
    common.add_argument("--key", help="API key; default: SEEDMESH_KEY")
    common.add_argument("--program", metavar="FILE", help="run this seedmesh program as the server, on a free port")
    parser = argparse.ArgumentParser(prog="python -m seedmesh", description="Models from a Seedmesh server.")
    commands = parser.add_subparsers(dest="command", required=True)
    sync = commands.add_parser("sync", parents=[common], help="make what changed in the request files below a directory")
    sync.add_argument("directory")
    sync.add_argument("--check", action="store_true", help="write nothing; status 1 if something would change")
    sync.add_argument("--list", action="store_true", help="print the files that are made, and end")
    sync.add_argument("--jobs", type=int, default=4, help="requests at the same time (default 4)")
    sync.set_defaults(run=_sync)
    for name, text in [("generate", "keep a model in a file"), ("validate", "check a request"),
                       ("derive", "print the result before geometry"), ("permalink", "print a link that contains the request")]:
        one = commands.add_parser(name, parents=[common], help=text)
        one.add_argument("file", help="a request file")
        if name == "generate":
            one.add_argument("-o", "--output", help="default: beside the request file")
        one.set_defaults(run=_one)
    commands.add_parser("presets", parents=[common], help="list the gallery").set_defaults(run=_presets)
    return parser


def main(words: Optional[List[str]] = None) -> int:
    arguments = _parser().parse_args(words)
    if getattr(arguments, "directory", None) is not None and not os.path.isdir(arguments.directory):
        print(f"found no directory {arguments.directory}", file=sys.stderr)
        return 2
    try:
        return int(arguments.run(arguments))
    except (SeedmeshError, Unreadable) as error:
        print(error, file=sys.stderr)
        return 1
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
