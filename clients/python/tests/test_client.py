import asyncio
import json
import struct
import time
import unittest
import urllib.request

from seedmesh import AsyncClient, Busy, Client, Refused
from seedmesh.links import sign
from stub_server import StubServer
from support import InFolder, server_url

plant = {"generator": "lsystem", "seed": 3, "parameters": {"axiom": "F", "productions": ["F -> F[+F]F"], "iterations": 3}}


def triangles_of(glb: bytes) -> int:
    """Counted in the file itself."""
    size, = struct.unpack_from("<I", glb, 12)
    document = json.loads(glb[20:20 + size])
    return sum(document["accessors"][each["indices"]]["count"] // 3 for mesh in document["meshes"] for each in mesh["primitives"])


class Calls(InFolder):
    def setUp(self) -> None:
        super().setUp()
        self.client = Client(server_url())

    def test_a_model_is_the_one_that_the_service_gives(self) -> None:
        model = self.client.generate(plant)
        self.assertEqual(model.data[:4], b"glTF")
        self.assertEqual(len(model.data), struct.unpack_from("<I", model.data, 8)[0])
        self.assertEqual(model.triangles, triangles_of(model.data))
        self.assertEqual(model.media_type, "model/gltf-binary")
        with urllib.request.urlopen(server_url() + str(model.link)) as answer:
            self.assertEqual(answer.read(), model.data)

    def test_presets_have_pictures(self) -> None:
        data = self.client.thumbnail("oak")
        self.assertEqual((data[:4], data[8:12]), (b"RIFF", b"WEBP"))
        with self.assertRaises(Refused):
            self.client.thumbnail("oakk")

    def test_models_have_pictures(self) -> None:
        data = self.client.picture(plant, size=64, view="front")
        self.assertEqual((data[:4], data[8:16]), (b"RIFF", b"WEBPVP8 "))
        width, height = struct.unpack_from("<HH", data, 26)
        self.assertEqual((width, height), (64, 64))
        with self.assertRaises(Refused) as caught:
            self.client.picture(plant, size=9)
        self.assertEqual([each["pointer"] for each in caught.exception.errors], ["/size"])

    def test_a_permalink_is_made_without_the_server_and_gives_the_same_bytes(self) -> None:
        link = self.client.permalink(plant)
        with urllib.request.urlopen(link) as answer:
            self.assertEqual(answer.read(), self.client.generate(plant).data)
        with urllib.request.urlopen(self.client.permalink(plant, "json")) as answer:
            self.assertEqual(json.load(answer)["parameters"]["axiom"], "F")
        self.assertTrue(self.client.permalink({"generator": "terrain", "output": {"format": "png16"}}).endswith(".png"))
        with self.assertRaisesRegex(ValueError, "at most 8000"):
            self.client.permalink({"generator": "lsystem", "parameters": {"axiom": "".join(map(str, range(9000)))}})

    def test_a_preset_url_overrides_seed_and_parameters(self) -> None:
        url = self.client.preset_url("koch_island", query={"seed": 3, "iterations": 2})
        with urllib.request.urlopen(url) as answer:
            expected = self.client.generate({"preset": "koch_island", "seed": 3, "parameters": {"iterations": 2}})
            self.assertEqual(answer.read(), expected.data)

    def test_a_word_is_derived_as_the_grammar_says(self) -> None:
        derived = self.client.derive({"generator": "lsystem", "parameters": {"axiom": "A", "productions": ["A -> AB", "B -> A"], "iterations": 5}})
        self.assertEqual(derived["string"], "ABAABABAABAAB")  # the Fibonacci word of 13 letters

    def test_validate_estimates_and_warns(self) -> None:
        answer = self.client.validate(plant)
        self.assertEqual((answer["valid"], answer["warnings"]), (True, []))
        warned = self.client.validate({**plant, "parameters": {**plant["parameters"], "productions": ["F -> F : 0.5"]}})
        self.assertEqual([each["pointer"] for each in warned["warnings"]][:1], ["/parameters/productions/0"])

    def test_presets_are_listed_by_generator(self) -> None:
        names = {each["name"]: each["generator"] for each in self.client.presets()}
        self.assertEqual(names["oak"], "tree")
        trees = self.client.presets("tree")
        self.assertEqual({each["generator"] for each in trees}, {"tree"})
        self.assertEqual(self.client.preset("oak")["generator"], "tree")

    def test_a_refusal_has_every_error_with_its_pointer(self) -> None:
        with self.assertRaises(Refused) as caught:
            self.client.generate({"generator": "lsystem", "parameters": {"axiom": "F[", "iterations": -1}})
        self.assertEqual(caught.exception.status, 422)
        by_pointer = {each["pointer"]: each for each in caught.exception.errors}
        self.assertEqual(set(by_pointer), {"/parameters/axiom", "/parameters/iterations"})
        self.assertEqual((by_pointer["/parameters/axiom"]["line"], by_pointer["/parameters/axiom"]["column"]), (1, 2))
        self.assertIn("/parameters/axiom:1:2: ", str(caught.exception))

    def test_fetch_sends_a_model_once(self) -> None:
        path = self.folder / "plant.glb"
        self.assertTrue(self.client.fetch(plant, str(path)))
        data = path.read_bytes()
        self.assertFalse(self.client.fetch(plant, str(path)))
        path.write_bytes(b"changed by hand")
        self.assertTrue(self.client.fetch(plant, str(path)))
        self.assertEqual(path.read_bytes(), data)
        self.assertTrue(self.client.fetch({**plant, "seed": 4}, str(path)))
        self.assertEqual(self.names(), ["plant.glb", "plant.glb.lock"])

    def test_the_cache_gives_the_same_model_after_304(self) -> None:
        first = Client(server_url(), cache=str(self.folder)).generate(plant)
        second = Client(server_url(), cache=str(self.folder)).generate(plant)
        self.assertEqual(first, second)

    def test_async_calls_run_at_the_same_time(self) -> None:
        async def both() -> list:
            client = AsyncClient(server_url())
            return await asyncio.gather(*(client.generate({**plant, "seed": seed}) for seed in (1, 2)))
        models = asyncio.run(both())
        self.assertEqual([model.data for model in models], [self.client.generate({**plant, "seed": seed}).data for seed in (1, 2)])


class Answers(InFolder):
    """What happens at answers that a test prepares."""

    busy = (429, {"Retry-After": "1", "Content-Type": "application/problem+json"}, b'{"type": "queue-full", "title": "Busy", "status": 429}')
    model = (200, {"Content-Type": "model/gltf-binary", "ETag": '"a"', "Seedmesh-Triangles": "12"}, b"glTF")

    def test_a_busy_server_is_asked_again_after_the_time_that_it_names(self) -> None:
        with StubServer([self.busy, self.model]) as server:
            begin = time.monotonic()
            self.assertEqual(Client(server.url).generate(plant).triangles, 12)
            self.assertGreaterEqual(time.monotonic() - begin, 1)
            self.assertEqual([each[:2] for each in server.seen], [("POST", "/v1/generate")] * 2)

    def test_patience_ends(self) -> None:
        with StubServer([self.busy]) as server:
            with self.assertRaises(Busy) as caught:
                Client(server.url, patience=0.5).generate(plant)
            self.assertEqual((caught.exception.status, len(server.seen)), (429, 1))

    def test_an_error_without_a_problem_has_its_status(self) -> None:
        with StubServer([(502, {}, b"<html>")]) as server:
            with self.assertRaisesRegex(Refused, "HTTP status 502"):
                Client(server.url).generate(plant)

    def test_the_key_is_sent_and_not_to_another_server(self) -> None:
        with StubServer([self.model]) as other, StubServer([(307, {"Location": other.url + "/x"}, b"")]) as server:
            with self.assertRaisesRegex(OSError, "redirects to another server"):
                Client(server.url, "secret").preset("oak")
            self.assertEqual(server.seen[0][2]["Authorization"], "Bearer secret")
            self.assertEqual(other.seen, [])

    def test_a_model_that_is_cut_off_leaves_no_file(self) -> None:
        with StubServer([(200, {"Content-Length": "1000"}, b"glTF")]) as server:
            with self.assertRaises(Exception):
                Client(server.url).fetch(plant, str(self.folder / "plant.glb"))
        self.assertEqual(self.names(), [])

    def test_a_url_that_is_none_is_refused(self) -> None:
        with self.assertRaisesRegex(ValueError, "expected an address like"):
            Client("localhost:8080")

    def test_a_signature_covers_path_and_query(self) -> None:
        # Computed with: openssl dgst -sha256 -hmac secret -binary | basenc --base64url
        self.assertEqual(sign("/v1/presets/oak.glb?seed=3", "a", b"secret", 5),
                         "/v1/presets/oak.glb?seed=3&expires=5&key=a&signature=0uT3yBvA3s1G6_xBX__bR4uUSRL1QtirgK6OPefPf7w")


if __name__ == "__main__":
    unittest.main()
