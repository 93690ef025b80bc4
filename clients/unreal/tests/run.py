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
    delete_directory = staticmethod(lambda target: [assets.pop(each) for each in list(assets) if each.startswith(target + "/")])


class Editor:
    def set_lod_from_static_mesh(self, mesh, level, source, _source_level, _reuse):
        mesh.levels[level] = source.path
        return level


project = tempfile.mkdtemp()
unreal = types.ModuleType("unreal")
unreal.StaticMesh, unreal.EditorAssetLibrary, unreal.StaticMeshEditorSubsystem = StaticMesh, Library, Editor
unreal.InterchangeManager = types.SimpleNamespace(get_interchange_manager_scripted=Manager)
unreal.ImportAssetParameters = types.SimpleNamespace
unreal.get_editor_subsystem = lambda kind: kind()
unreal.Paths = types.SimpleNamespace(project_dir=lambda: project)
unreal.log_error = errors.append
sys.modules["unreal"] = unreal

import seedmesh_unreal  # noqa: E402

paths = seedmesh_unreal.import_model({"preset": "oak", "seed": 3, "output": {"lods": 3, "textures": 64}}, "oak_3", nanite=True)
assert paths and all(each.startswith("/Game/Seedmesh/oak_3/") for each in paths), paths
visible = [mesh for mesh in assets.values() if mesh.levels]
assert visible and all(set(mesh.levels) == {1, 2} for mesh in visible), [(mesh.path, mesh.levels) for mesh in assets.values()]
assert all(mesh.properties.get("enabled") for mesh in assets.values())
assert not [each for each in assets if "/level_" in each]

os.mkdir(os.path.join(project, "Seedmesh"))
Path(project, "Seedmesh/good.seedmesh").write_text('{"$schema": "x", "preset": "koch_snowflake"}')
Path(project, "Seedmesh/bad.seedmesh").write_text('{"preset": "oakk"}')
assert seedmesh_unreal.import_all() == 1 and "/preset: " in errors[0], errors
try:
    seedmesh_unreal.import_model({"preset": "oak"}, "a b")
    raise AssertionError("the name was taken")
except ValueError:
    print("ok")
