"""Runs the plugin on a stub of the module unreal, which records calls, and on a real server (SEEDMESH_URL)."""
import json
import os
import sys
import tempfile
import types
from pathlib import Path

here = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(here / "Content/Python"), str(here.parent / "python/src")]


class StaticMesh:
    def __init__(self, path):
        self.path, self.levels, self.properties = path, {}, {}

    def get_name(self):
        return self.path.split("/")[-1]

    def get_path_name(self):
        return self.path

    def get_editor_property(self, name):
        return self.properties.setdefault(name, types.SimpleNamespace(set_editor_property=lambda key, value: self.properties.update({key: value})))

    def set_editor_property(self, name, value):
        self.properties[name] = value


assets, errors = {}, []


class Manager:
    def create_source_data(self, path):
        return path

    def import_asset(self, target, path, parameters):
        """A static mesh for each mesh of the file, with its name."""
        document = json.loads(Path(path).read_text())
        assert parameters.is_automated and all((Path(path).parent / each["uri"]).exists() for each in document["buffers"])
        for mesh in document["meshes"]:
            assets[f"{target}/{mesh['name']}"] = StaticMesh(f"{target}/{mesh['name']}")
        return True


class Library:
    list_assets = staticmethod(lambda target, _recursive: [each for each in assets if each.startswith(target + "/")])
    load_asset = staticmethod(lambda path: assets[path])
    save_loaded_asset = staticmethod(lambda mesh: None)
    does_asset_exist = staticmethod(lambda path: path in assets)
    delete_asset = staticmethod(lambda path: assets.pop(path))
    delete_directory = staticmethod(lambda target: [assets.pop(each) for each in list(assets) if each.startswith(target + "/")])


class Editor:
    def set_lod_from_static_mesh(self, mesh, level, source, _source_level, _reuse):
        mesh.levels[level] = source.path
        return level

    def get_lod_count(self, mesh):
        return 1 + len(mesh.levels)

    def set_lod_screen_sizes(self, mesh, sizes):
        assert len(sizes) == self.get_lod_count(mesh) and all(a > b for a, b in zip(sizes, sizes[1:])), sizes
        mesh.sizes = list(sizes)
        return True


class Quat:
    """Rotates by the quaternion product, which has no handedness; rotator() keeps the quaternion, to compare it."""

    def __init__(self, x, y, z, w):
        self.q = (x, y, z, w)

    def rotator(self):
        return self

    def rotate(self, v):
        x, y, z, w = self.q
        t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
        return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]


def moved(translation, rotation, scale, point):
    """A point by scale, rotation and translation."""
    turned = rotation.rotate([s * p for s, p in zip(scale, point)])
    return [t + p for t, p in zip(translation, turned)]


class Tools:
    def create_asset(self, name, target, _kind, _factory):
        assets[f"{target}/{name}"] = StaticMesh(f"{target}/{name}")
        return assets[f"{target}/{name}"]


foliage = []
project = tempfile.mkdtemp()
unreal = types.ModuleType("unreal")
unreal.StaticMesh, unreal.EditorAssetLibrary, unreal.StaticMeshEditorSubsystem = StaticMesh, Library, Editor
unreal.InterchangeManager = types.SimpleNamespace(get_interchange_manager_scripted=Manager)
unreal.ImportAssetParameters = types.SimpleNamespace
unreal.get_editor_subsystem = lambda kind: kind()
unreal.Paths = types.SimpleNamespace(project_dir=lambda: project)
unreal.log_error = errors.append
unreal.Quat, unreal.Vector, unreal.Transform = Quat, lambda *values: values, lambda *parts: parts
unreal.UnrealEditorSubsystem = lambda: types.SimpleNamespace(get_editor_world=lambda: "world")
unreal.AssetToolsHelpers = types.SimpleNamespace(get_asset_tools=Tools)
unreal.FoliageType_InstancedStaticMesh, unreal.FoliageType_InstancedStaticMeshFactory = object, object
unreal.InstancedFoliageActor = types.SimpleNamespace(add_instances=lambda world, kind, transforms: foliage.append((kind, transforms)))
sys.modules["unreal"] = unreal

import seedmesh_unreal  # noqa: E402

paths = seedmesh_unreal.import_model({"preset": "oak", "seed": 3, "output": {"lods": 3, "textures": 64}}, "oak_3", nanite=True)
assert paths and all(each.startswith("/Game/Seedmesh/oak_3/") for each in paths), paths
visible = [mesh for mesh in assets.values() if mesh.levels]
assert visible and all(set(mesh.levels) == {1, 2} for mesh in visible), [(mesh.path, mesh.levels) for mesh in assets.values()]
assert all(mesh.sizes == [1, 0.5, 0.25] for mesh in visible), [mesh.sizes for mesh in visible]
assert all(mesh.properties.get("enabled") for mesh in assets.values())
assert not [each for each in assets if "/level_" in each]

# Of a list, a level begins at the root of its share of the triangles.
listed = seedmesh_unreal.import_model({"preset": "oak", "seed": 3, "output": {"lods": [1, 0.25, 0.04], "textures": 64}}, "oak_listed")
sizes = [assets[path].sizes for path in listed if assets[path].levels]
assert sizes and all(abs(a - b) < 0.02 for each in sizes for a, b in zip(each, [1, 0.5, 0.2])), sizes

scene = {"preset": "orchard"}
derived = seedmesh_unreal.seedmesh.Client().derive(scene)
for again in range(2):
    foliage.clear()
    assert seedmesh_unreal.plant(scene, "orchard") == len(derived["placements"])
    assert len(foliage) >= len(derived["models"])
    for kind, transforms in foliage:
        model = kind.path.split("/")[-2][len("orchard_"):]
        expected = [each for each in derived["placements"] if each["model"] == model]
        assert len(transforms) == len(expected) and kind.properties["mesh"].path.startswith(f"/Game/Seedmesh/orchard_{model}/")
        for (location, turn, scale), place in zip(transforms, expected):
            # Moving a point and then turning the axes gives the same as turning the axes and then moving.
            point = (0.3, 1.7, -0.4)
            x, y, z = moved(place["translation"], Quat(*place["rotation"]), place["scale"], point)
            found = moved(location, turn, scale, (100 * point[0], 100 * point[2], 100 * point[1]))
            assert max(abs(a - b) for a, b in zip(found, (100 * x, 100 * z, 100 * y))) < 1e-6, (found, x, y, z)

os.mkdir(os.path.join(project, "Seedmesh"))
Path(project, "Seedmesh/good.seedmesh").write_text('{"$schema": "x", "preset": "koch_snowflake"}')
Path(project, "Seedmesh/bad.seedmesh").write_text('{"preset": "oakk"}')
assert seedmesh_unreal.import_all() == 1 and "/preset: " in errors[0], errors
try:
    seedmesh_unreal.import_model({"preset": "oak"}, "a b")
    raise AssertionError("the name was taken")
except ValueError:
    print("ok")
