# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender without a window:  blender -b --factory-startup --python run.py -- ADDON.zip URL"""
import json
import struct
import sys
import traceback
import unittest
import urllib.request

import bpy

archive, url = sys.argv[sys.argv.index("--") + 1:]


def install():
    """As the preferences do it: an add-on before 4.2, an extension since."""
    if bpy.app.version < (4, 2):
        bpy.ops.preferences.addon_install(filepath=archive)
        name = "seedmesh"
    else:
        bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default")
        name = "bl_ext.user_default.seedmesh"
    bpy.ops.preferences.addon_enable(module=name)
    bpy.context.preferences.addons[name].preferences.url = url
    return name


def served(target):
    with urllib.request.urlopen(url + target) as answer:
        return answer.read()


def posted(request):
    asked = urllib.request.Request(url + "/v1/generate", json.dumps(request).encode(), {"Content-Type": "application/json"})
    with urllib.request.urlopen(asked) as answer:
        return answer.read()


def triangles_of_file(glb):
    size, = struct.unpack_from("<I", glb, 12)
    document = json.loads(glb[20:20 + size])
    return sum(document["accessors"][each["indices"]]["count"] // 3 for mesh in document["meshes"] for each in mesh["primitives"])


def triangles_of(objects):
    count = 0
    for each in objects:
        if each.type == "MESH":
            each.data.calc_loop_triangles()
            count += len(each.data.loop_triangles)
    return count


def refused(operator, **values):
    """An operator that reports an error raises it in a script."""
    try:
        operator(**values)
    except RuntimeError as error:
        return str(error)
    raise AssertionError("no error was reported")


class AddOn(unittest.TestCase):
    def setUp(self):
        for each in list(bpy.data.objects):
            bpy.data.objects.remove(each, do_unlink=True)
        for each in list(bpy.data.collections):
            bpy.data.collections.remove(each)
        for each in list(bpy.data.materials):
            bpy.data.materials.remove(each)
        self.settings = bpy.context.scene.seedmesh
        for name in ("lods", "collision", "animation", "count", "preset"):
            self.settings.property_unset(name)
        self.settings.parameters.clear()
        self.settings.errors.clear()

    def test_grow_makes_the_model_of_the_file_below_one_root(self):
        self.assertEqual(bpy.ops.seedmesh.grow(preset="oak", seed=3), {"FINISHED"})
        root = bpy.context.object
        self.assertEqual(root.name, "oak_3")
        expected = triangles_of_file(served("/v1/presets/oak.glb?seed=3&output.profile=blender"))
        self.assertEqual(triangles_of(root.children_recursive + [root]), expected)
        request = json.loads(root["seedmesh_request"])
        self.assertEqual((request["preset"], request["seed"]), ("oak", 3))
        self.assertEqual([each.name for each in bpy.context.scene.collection.children], ["oak_3"])

    def test_regrow_keeps_position_materials_and_copies(self):
        bpy.ops.seedmesh.grow(preset="oak", seed=3)
        root = bpy.context.object
        root.location = (4, 5, 6)
        bpy.context.view_layer.update()
        materials = {each.name for each in bpy.data.materials}
        before = triangles_of(root.children_recursive)
        mine = next(each for each in bpy.data.materials if "bark" in each.name)
        mine["mine"] = 1
        self.assertEqual(bpy.ops.seedmesh.regrow(seed=4), {"FINISHED"})
        root = bpy.context.object
        bpy.context.view_layer.update()
        self.assertEqual([round(each, 4) for each in root.matrix_world.translation], [4, 5, 6])
        self.assertNotEqual(triangles_of(root.children_recursive), before)
        self.assertEqual(json.loads(root["seedmesh_request"])["seed"], 4)
        self.assertEqual({each.name for each in bpy.data.materials}, materials)
        used = {slot.material.name for each in root.children_recursive for slot in each.material_slots}
        self.assertIn(mine.name, used)
        self.assertEqual(len(bpy.context.scene.collection.children), 1)

    def test_levels_and_collision_are_hidden_collections(self):
        self.settings.lods = 3
        self.settings.collision = True
        bpy.ops.seedmesh.grow(preset="oak", seed=3)
        model = bpy.data.collections["oak_3"]
        hidden = {each.name: each for each in model.children if each.hide_viewport and each.hide_render}
        self.assertTrue({"oak_3_LOD1", "oak_3_LOD2", "oak_3_collision"} <= set(hidden), sorted(hidden))
        counts = [triangles_of(model.objects), triangles_of(hidden["oak_3_LOD1"].objects), triangles_of(hidden["oak_3_LOD2"].objects)]
        self.assertTrue(counts[0] > counts[1] > counts[2] > 0, counts)
        self.assertTrue(all(each.name.startswith("collision") for each in hidden["oak_3_collision"].objects))

    def test_errors_name_their_field(self):
        self.assertIn("oakk", refused(bpy.ops.seedmesh.grow, preset="oakk"))
        self.assertEqual([each.pointer for each in self.settings.errors], ["/preset"])
        self.assertEqual(len(bpy.data.objects), 0)

    def test_parameters_come_from_the_schema(self):
        self.settings.preset = "koch_island"
        self.assertEqual(bpy.ops.seedmesh.parameters(), {"FINISHED"})
        self.assertEqual(self.settings.generator, "lsystem")
        iterations = self.settings.parameters["iterations"]
        schema = json.loads(served("/v1/schemas/lsystem"))["properties"]["iterations"]
        self.assertEqual((iterations.kind, iterations.title, iterations.group), ("integer", schema["title"], schema["x-group"]))
        preset = json.loads(served("/v1/presets/koch_island"))
        self.assertEqual(iterations.value(), preset["parameters"]["iterations"])
        iterations.value_integer, iterations.is_given = 1, True
        self.assertEqual(self.settings.request()["parameters"], {"iterations": 1})
        iterations.value_integer = -1
        refused(bpy.ops.seedmesh.grow)
        self.assertEqual([each.pointer for each in self.settings.errors], ["/parameters/iterations"])

    def test_the_gallery_is_listed(self):
        self.assertEqual(bpy.ops.seedmesh.gallery(), {"FINISHED"})
        self.assertEqual(len(self.settings.presets), len(json.loads(served("/v1/presets"))["presets"]))
        pictures = sys.modules[module + ".pictures"]
        for each in self.settings.presets:
            self.assertEqual(tuple(bpy.data.images.load(pictures.path(each.name)).size), (192, 144), each.name)
            pictures.icon(each.name)
        self.assertEqual(pictures.icon("oakk"), 0)

    def test_a_picture_shows_the_model_of_the_parameters(self):
        pictures = sys.modules[module + ".pictures"]
        bpy.ops.seedmesh.choose(preset="koch_island")
        names = []
        for seed in (1, 2):
            self.settings.seed = seed
            self.assertEqual(bpy.ops.seedmesh.picture(), {"FINISHED"})
            names.append(self.settings.picture)
            self.assertEqual(tuple(bpy.data.images.load(pictures.path(names[-1])).size), (256, 256))
        self.assertNotEqual(*names)
        bpy.ops.seedmesh.choose(preset="oak")
        self.assertEqual(self.settings.picture, "")

    def test_copies_lie_on_the_surface_and_on_the_curve(self):
        bpy.ops.seedmesh.grow(preset="koch_snowflake", seed=0)
        root = bpy.context.object
        model = root.users_collection[0]
        bpy.ops.mesh.primitive_plane_add(size=10, location=(0, 0, 2))
        self.settings.count = 30
        root.select_set(True)
        self.assertEqual(bpy.ops.seedmesh.scatter(), {"FINISHED"})
        copies = [each for each in bpy.data.objects if each.instance_collection == model]
        self.assertEqual(len(copies), 30)
        for each in copies:
            x, y, z = each.matrix_world.translation
            self.assertTrue(abs(x) <= 5.001 and abs(y) <= 5.001 and abs(z - 2) < 1e-4)
        self.assertGreater(len({round(each.matrix_world.translation.x, 3) for each in copies}), 25)
        bpy.ops.curve.primitive_bezier_circle_add(radius=4)
        root.select_set(True)
        self.settings.count = 8
        bpy.ops.seedmesh.scatter()
        on_curve = [each for each in bpy.data.objects if each.instance_collection == model and each not in copies]
        self.assertEqual(len(on_curve), 8)
        for each in on_curve:
            self.assertLess(abs(each.matrix_world.translation.length - 4), 0.1)

    def test_a_model_read_back_from_its_property_gives_the_same_bytes(self):
        for preset in ("koch_island", "birch"):
            with self.subTest(preset):
                self.settings.errors.clear()
                bpy.ops.seedmesh.grow(preset=preset, seed=4)
                sent = json.loads(bpy.context.object["seedmesh_request"])
                canonical = bpy.context.object["request"]  # written by the service, kept by Blender's importer
                self.assertEqual(posted(json.loads(canonical)), posted(sent))
                self.assertEqual(posted(json.loads(bpy.data.scenes[0]["request"])), posted(sent))

    def test_growth_ends_full_grown(self):
        self.settings.animation = True
        bpy.ops.seedmesh.grow(preset="growing_tree", seed=0)
        self.assertGreater(bpy.context.scene.frame_current, 100)


module = install()
result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(AddOn))
status = 0 if result.wasSuccessful() else 1
try:
    bpy.ops.preferences.addon_disable(module=module)
    assert not hasattr(bpy.types, "SEEDMESH_PT_panel") and not hasattr(bpy.types.Scene, "seedmesh"), "the panel is still there"
except Exception:
    traceback.print_exc()
    status = 1
print(f"{result.testsRun} tests, status {status}")
sys.exit(status)
