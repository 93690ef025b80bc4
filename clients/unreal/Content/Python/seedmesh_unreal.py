"""Imports models of a Seedmesh server into Unreal, by the Python client beside this file.

    import seedmesh_unreal
    seedmesh_unreal.import_model({"preset": "oak", "seed": 7, "output": {"lods": 3}}, "oak_7")
    seedmesh_unreal.import_all()
    seedmesh_unreal.plant({"preset": "orchard"}, "orchard")
"""
import json
import os
import re
import tempfile
import zipfile
from io import BytesIO
from typing import Any, Dict, List

import seedmesh
import unreal

folder = "/Game/Seedmesh"
allowed_name = re.compile(r"[A-Za-z0-9_-]+")


def import_model(request: Dict[str, Any], name: str, nanite: bool = False) -> List[str]:
    """Makes a model and imports it as /Game/Seedmesh/<name>. The result are the paths of its static meshes."""
    if not allowed_name.fullmatch(name):
        raise ValueError(f"found the name {name!r}, expected letters, digits, _ and -")
    output = {"collision": "unreal", **request.get("output", {}), "profile": "unreal", "format": "zip"}
    model = seedmesh.Client().generate({**request, "output": output})  # type: ignore[arg-type]
    with tempfile.TemporaryDirectory() as place:
        zipfile.ZipFile(BytesIO(model.data)).extractall(place)
        files = {level_of(file): os.path.join(place, file) for file in os.listdir(place) if file.endswith(".gltf")}
        meshes = import_file(files[0], f"{folder}/{name}")
        for level in sorted(set(files) - {0}):
            add_level(meshes, import_file(files[level], f"{folder}/{name}/level_{level}"), level)
            unreal.EditorAssetLibrary.delete_directory(f"{folder}/{name}/level_{level}")
        set_screen_sizes(meshes, files[0])
    for mesh in meshes:
        if nanite:
            settings = mesh.get_editor_property("nanite_settings")
            settings.set_editor_property("enabled", True)
            mesh.set_editor_property("nanite_settings", settings)
        unreal.EditorAssetLibrary.save_loaded_asset(mesh)
    return [mesh.get_path_name() for mesh in meshes]


def level_of(file: str) -> int:
    match = re.search(r"_LOD(\d+)\.gltf$", file)
    return int(match.group(1)) if match else 0


def import_file(path: str, target: str) -> List[Any]:
    """Imports a glTF file by Interchange. The result are the static meshes below the target."""
    manager = unreal.InterchangeManager.get_interchange_manager_scripted()
    parameters = unreal.ImportAssetParameters()
    parameters.is_automated = True
    parameters.replace_existing = True
    if not manager.import_asset(target, manager.create_source_data(path), parameters):
        raise RuntimeError(f"Interchange could not import {path}")
    assets = [unreal.EditorAssetLibrary.load_asset(each) for each in unreal.EditorAssetLibrary.list_assets(target, True)]
    return [each for each in assets if isinstance(each, unreal.StaticMesh)]


def add_level(meshes: List[Any], coarser: List[Any], level: int) -> None:
    """Gives each mesh the coarser mesh with the same name as a level of detail."""
    editor = unreal.get_editor_subsystem(unreal.StaticMeshEditorSubsystem)
    by_name = {re.sub(r"_LOD\d+$", "", each.get_name()): each for each in coarser}
    for mesh in meshes:
        source = by_name.get(mesh.get_name())
        if source is not None and editor.set_lod_from_static_mesh(mesh, level, source, 0, True) < 0:
            raise RuntimeError(f"level {level} of {mesh.get_name()} could not be set")


def screen_sizes(file: str) -> List[float]:
    """The screen size below which each level of a glTF file is shown, the finest first; empty: it has one level. The service gives
    shares of the screen's height. Unreal's screen size is the same of the sphere around the mesh, as the picture is wider than high."""
    with open(file, encoding="utf-8") as opened:
        document = json.load(opened)
    levels = [node["extras"]["levels"] for node in document["nodes"] if "levels" in node.get("extras", {})]
    return [each["screen"] for each in levels[0]["list"]] if levels else []


def set_screen_sizes(meshes: List[Any], file: str) -> None:
    """Sets at which screen size each level of the meshes begins."""
    editor, sizes = unreal.get_editor_subsystem(unreal.StaticMeshEditorSubsystem), screen_sizes(file)
    for mesh in meshes:
        count = editor.get_lod_count(mesh)
        if 1 < count <= len(sizes) and not editor.set_lod_screen_sizes(mesh, sizes[:count]):
            raise RuntimeError(f"the screen sizes of {mesh.get_name()} could not be set")


def plant(request: Dict[str, Any], name: str) -> int:
    """Imports the models of a scene request, and adds their copies to the open level as foliage. The result is the number of copies
    of models. The terrain of the scene is not part of it."""
    derived = seedmesh.Client().derive({**request})  # type: ignore[call-overload]
    world = unreal.get_editor_subsystem(unreal.UnrealEditorSubsystem).get_editor_world()
    for model, child in derived["models"].items():
        transforms = [transform_of(each) for each in derived["placements"] if each["model"] == model]
        for path in import_model(child, f"{name}_{model}"):
            kind = foliage_type(unreal.EditorAssetLibrary.load_asset(path), f"{folder}/{name}_{model}")
            unreal.InstancedFoliageActor.add_instances(world, kind, transforms)
    return len(derived["placements"])


def foliage_type(mesh: Any, target: str) -> Any:
    """A new foliage type for a static mesh."""
    name = mesh.get_name() + "_foliage"
    if unreal.EditorAssetLibrary.does_asset_exist(f"{target}/{name}"):
        unreal.EditorAssetLibrary.delete_asset(f"{target}/{name}")
    tools = unreal.AssetToolsHelpers.get_asset_tools()
    kind = tools.create_asset(name, target, unreal.FoliageType_InstancedStaticMesh, unreal.FoliageType_InstancedStaticMeshFactory())
    kind.set_editor_property("mesh", mesh)
    unreal.EditorAssetLibrary.save_loaded_asset(kind)
    return kind


def transform_of(placement: Dict[str, Any]) -> Any:
    """A placement in Unreal's axes, as Interchange turns those of glTF: centimetres, and Y exchanged with Z. Exchanging two axes
    turns the direction of rotations."""
    x, y, z = placement["translation"]
    i, j, k, w = placement["rotation"]
    a, b, c = placement["scale"]
    turn = unreal.Quat(-i, -k, -j, w)
    return unreal.Transform(unreal.Vector(100 * x, 100 * z, 100 * y), turn.rotator(), unreal.Vector(a, c, b))


def import_all() -> int:
    """Imports each request file below the directory Seedmesh of the project. The result is the number of refused files."""
    place = os.path.join(unreal.Paths.project_dir(), "Seedmesh")
    refused = 0
    for directory, _, names in os.walk(place):
        for file in sorted(each for each in names if each.endswith(".seedmesh")):
            path = os.path.join(directory, file)
            try:
                with open(path, encoding="utf-8") as opened:
                    request = {key: each for key, each in json.load(opened).items() if key not in ("$schema", "name", "outputs")}
                import_model(request, file[:-len(".seedmesh")])
            except (seedmesh.SeedmeshError, OSError, ValueError) as error:
                unreal.log_error(f"{path}: {error}")
                refused += 1
    return refused
