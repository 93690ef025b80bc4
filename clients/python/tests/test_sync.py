import json
import os
import signal
import subprocess
import sys
import time
import unittest

from seedmesh.client import Client
from seedmesh.positions import Positions, parse
from seedmesh.request_file import Unreadable, read_request_file
from seedmesh.sync import Sync
from stub_server import StubServer
from support import InFolder, server_url

koch = '{"preset": "koch_snowflake", "seed": 2}'


def command(*words: str, **environment: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-m", "seedmesh", *words], capture_output=True, text=True, env={**os.environ, **environment})


class Syncing(InFolder):
    def sync(self) -> Sync:
        sync = Sync(str(self.folder), Client(server_url()))
        sync.run()
        return sync

    def test_models_are_made_once(self) -> None:
        self.write("a.seedmesh", koch)
        self.write("deep/b.seedmesh", '{"$schema": "request.json", "preset": "koch_snowflake", "name": "snow", "output": {"format": "gltf"}}')
        self.assertEqual(self.sync().report.made, 2)
        self.assertEqual(self.names(), ["a.glb", "a.seedmesh", "deep/b.seedmesh", "deep/snow.gltf", "seedmesh.lock"])
        self.assertEqual((self.folder / "a.glb").read_bytes(), Client(server_url()).generate(json.loads(koch)).data)
        again = self.sync().report
        self.assertEqual((again.made, again.same, again.refused), (0, 2, 0))

    def test_an_unchanged_directory_asks_for_the_engine_alone(self) -> None:
        self.write("a.seedmesh", koch)
        self.sync()
        engine = json.dumps({"engine": Client(server_url()).engine()}).encode()
        with StubServer([(200, {}, engine)]) as stub:
            report = Sync(str(self.folder), Client(stub.url)).run()
            self.assertEqual((report.same, [each[1] for each in stub.seen]), (1, ["/version"]))

    def test_another_engine_makes_models_again(self) -> None:
        self.write("a.seedmesh", koch)
        self.sync()
        with StubServer([(200, {}, b'{"engine": "99-0"}'), (200, {"ETag": "x"}, b"new")]) as stub:
            self.assertEqual(Sync(str(self.folder), Client(stub.url)).check().changed, 1)
        with StubServer([(200, {}, b'{"engine": "99-0"}'), (200, {"ETag": "x"}, b"new")]) as stub:
            self.assertEqual(Sync(str(self.folder), Client(stub.url)).run().made, 1)
        self.assertEqual((self.folder / "a.glb").read_bytes(), b"new")

    def test_a_request_that_is_only_written_otherwise_is_not_sent_again(self) -> None:
        self.write("a.seedmesh", koch)
        self.sync()
        self.write("a.seedmesh", '{"seed": 2,\n "$schema": "request.json",\n "preset": "koch_snowflake"}')
        report = self.sync().report
        self.assertEqual((report.made, report.same, report.lines), (0, 1, []))
        self.assertEqual(Sync(str(self.folder), None).check().status, 0)

    def test_several_outputs_of_one_request(self) -> None:
        self.write("a.seedmesh", '{"preset": "koch_snowflake", "output": {"profile": "web"}, "outputs": {"a.glb": {}, "b.glb": {"profile": null}}}')
        self.sync()
        used = [b"KHR_mesh_quantization" in (self.folder / name).read_bytes() for name in ("a.glb", "b.glb")]
        self.assertEqual(used, [True, False])
        self.write("a.seedmesh", '{"preset": "koch_snowflake", "outputs": {"b.glb": {}}}')
        self.assertIn("removed a.glb", self.sync().report.lines)
        self.assertEqual(self.names(), ["a.seedmesh", "b.glb", "seedmesh.lock"])

    def test_a_refused_output_is_asked_for_again(self) -> None:
        self.write("a.seedmesh", '{"preset": "koch_snowflake",\n "outputs": {"a.glb": {},\n "b.glb": {"lods": 99}}}')
        for made, same in [(1, 0), (0, 1)]:
            report = self.sync().report
            self.assertEqual((report.made, report.same, report.refused), (made, same, 1))
            self.assertTrue(any("a.seedmesh:3:20: /outputs/b.glb/lods: found 99" in line for line in report.lines), report.lines)

    def test_outputs_of_removed_request_files_go_unless_somebody_changed_them(self) -> None:
        self.write("a.seedmesh", koch)
        self.write("b.seedmesh", koch)
        self.sync()
        (self.folder / "a.seedmesh").unlink()
        (self.folder / "b.seedmesh").unlink()
        self.write("b.glb", "mine")
        self.sync()
        self.assertEqual(self.names(), ["b.glb", "seedmesh.lock"])

    def test_two_files_with_one_output_are_refused(self) -> None:
        self.write("a.seedmesh", koch)
        self.write("b.seedmesh", '{"preset": "koch_snowflake", "name": "a"}')
        report = self.sync().report
        self.assertEqual((report.made, report.refused), (1, 1))
        self.assertIn("makes a.glb, which", report.lines[0])

    def test_a_killed_run_leaves_no_half_file(self) -> None:
        for seed in range(40):
            self.write(f"{seed}.seedmesh", f'{{"preset": "oak", "seed": {seed}}}')
        process = subprocess.Popen([sys.executable, "-m", "seedmesh", "sync", str(self.folder)], stdout=subprocess.DEVNULL,
                                   env={**os.environ, "SEEDMESH_URL": server_url()})
        while not any(name.endswith(".glb") for name in self.names()):
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.wait()
        models = [name for name in self.names() if name.endswith(".glb")]
        self.assertTrue(0 < len(models) < 40, len(models))
        for name in models:
            data = (self.folder / name).read_bytes()
            self.assertEqual(len(data), int.from_bytes(data[8:12], "little"), name)
        for seed in range(2, 40):
            (self.folder / f"{seed}.seedmesh").unlink()
        self.sync()
        self.assertFalse([name for name in self.names() if "part" in name])
        self.assertTrue({"0.glb", "1.glb"} <= set(self.names()))


class CommandLine(InFolder):
    def test_check_ends_with_1_on_drift_and_writes_nothing(self) -> None:
        self.write("a.seedmesh", koch)
        url = {"SEEDMESH_URL": server_url()}
        before = command("sync", "--check", str(self.folder), **url)
        self.assertEqual((before.returncode, before.stdout), (1, "changed a.glb\n1 changed, 0 same, 0 refused\n"))
        self.assertEqual(self.names(), ["a.seedmesh"])
        self.assertEqual(command("sync", str(self.folder), **url).returncode, 0)
        self.assertEqual(command("sync", "--check", str(self.folder), **url).returncode, 0)
        data = bytearray((self.folder / "a.glb").read_bytes())
        data[-1] ^= 1  # the same size
        (self.folder / "a.glb").write_bytes(data)
        self.assertEqual(command("sync", "--check", str(self.folder), SEEDMESH_URL="").returncode, 1)

    def test_errors_name_line_and_column_of_the_file(self) -> None:
        self.write("a.seedmesh", '{\n "generator": "lsystem",\n "parameters": {\n  "axiom": "F[", "iterations": -1}}')
        self.write("b.seedmesh", '{"seed": 1,\n "seed": 2}')
        self.write("c.seedmesh", '{"seed": }')
        self.write("d.seedmesh", '{"preset": "oak", "name": "../up"}')
        self.write("e.seedmesh", '{"seed": NaN}')
        out = command("sync", str(self.folder), SEEDMESH_URL=server_url())
        self.assertEqual(out.returncode, 1)
        for text in ["a.seedmesh:4:12: /parameters/axiom: ", "a.seedmesh:4:32: /parameters/iterations: found -1",
                     'b.seedmesh:2:2: the key "seed" is given twice', "c.seedmesh:1:10: ", "d.seedmesh:1:27: /name: ", "e.seedmesh:1:1: found NaN"]:
            self.assertIn(text, out.stdout)
        self.assertIn("0 made, 0 same, 5 refused", out.stdout)

    def test_without_a_server_the_status_is_2_if_something_has_to_be_made(self) -> None:
        self.write("a.seedmesh", koch)
        nowhere = {"SEEDMESH_URL": "http://127.0.0.1:9"}
        self.assertEqual(command("sync", str(self.folder), **nowhere).returncode, 2)
        self.assertEqual(command("sync", str(self.folder), SEEDMESH_URL=server_url()).returncode, 0)
        offline = command("sync", str(self.folder), **nowhere)
        self.assertEqual((offline.returncode, "its engine is not compared" in offline.stdout), (0, True))
        self.assertEqual(command("sync", str(self.folder / "none")).returncode, 2)

    def test_commands_that_take_one_file(self) -> None:
        path = str(self.write("a.seedmesh", '{"generator": "lsystem", "parameters": {"axiom": "FFF"}}'))
        url = {"SEEDMESH_URL": server_url()}
        self.assertEqual(json.loads(command("derive", path, **url).stdout)["string"], "FFF")
        self.assertTrue(json.loads(command("validate", path, **url).stdout)["valid"])
        self.assertTrue(command("permalink", path, **url).stdout.startswith(server_url() + "/v1/models/"))
        self.assertTrue(command("generate", path, **url).stdout.startswith("made "))
        self.assertTrue(command("generate", path, **url).stdout.startswith("same "))
        plain = str(self.write("plain_request.json", '{"generator": "lsystem", "parameters": {"axiom": "FFF"}}'))
        self.assertTrue(command("generate", plain, **url).stdout.strip().endswith("plain_request.glb"))
        self.assertIn("oak\ttree\t", command("presets", **url).stdout)


class RequestFiles(unittest.TestCase):
    def test_pointers_have_positions(self) -> None:
        text = '{\n  "a/b": [1, {"c~": "x\\"y"}],\n "d": {}\n}'
        parse(text)
        found = Positions(text)
        self.assertEqual(found.of("/a~1b/1/c~0"), (2, 21))
        self.assertEqual(found.of("/d"), (3, 7))
        self.assertEqual(found.of("/d/missing"), (3, 7))

    def test_files_that_are_no_requests(self) -> None:
        for text in ["[]", '{"outputs": {}}', '{"outputs": {"a/b.glb": {}}}', '{"outputs": {"a.glb": 1}}', '{"name": ".."}', '{"output": 3}',
                     '{"outputs": {"a.seedmesh": {}}}', '{"outputs": {"a.zip": {}}}', '{"outputs": {"a.glb": {"format": "gltf"}}}', "[" * 100000]:
            with self.assertRaises(Unreadable, msg=text[:40]):
                read_request_file("x.seedmesh", text)


if __name__ == "__main__":
    unittest.main()
