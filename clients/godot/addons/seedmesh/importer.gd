@tool
extends EditorSceneFormatImporter
## Imports a request file as a scene. The importer is selected by the last extension, which is why request files have one of their own.

const Service := preload("service.gd")
const Levels := preload("levels.gd")

## Members of a request file that the service does not know.
const OWN_MEMBERS: PackedStringArray = ["$schema", "name", "outputs"]
## JSON numbers arrive as floats, which are exact up to this number.
const LARGEST_SEED := 9007199254740992.0


func _get_extensions() -> PackedStringArray:
	return ["seedmesh"]


func _import_scene(path: String, flags: int, _options: Dictionary) -> Object:
	var request := _read(path)
	if request.is_empty():
		return null
	var output: Dictionary = request["output"]
	var lods: Variant = output.get("lods", 1)
	output.erase("lods")
	var finest := Service.post("/v1/generate", request)
	var root := _scene_of(path, finest, flags)
	var triangles := Levels.triangles_of(lods, finest.triangles)
	if root == null or triangles.size() < 2:
		return root
	var levels: Array[Node] = [root]
	output.erase("collision")
	for count: int in triangles.slice(1):
		output["max_triangles"] = count
		var scene := _scene_of(path, Service.post("/v1/generate", request), flags)
		if scene == null:
			return null
		levels.append(scene)
	Levels.join(levels, triangles, lods)
	return root


## The request of a file, for Godot; empty after an error.
func _read(path: String) -> Dictionary:
	var reader := JSON.new()
	if reader.parse(FileAccess.get_file_as_string(path)) != OK:
		push_error("%s:%d: %s" % [path, reader.get_error_line() + 1, reader.get_error_message()])
		return {}
	if not reader.data is Dictionary or not reader.data.get("output", {}) is Dictionary:
		push_error("%s: expected an object, and an object as its output" % path)
		return {}
	var request: Dictionary = reader.data
	for member in OWN_MEMBERS:
		request.erase(member)
	if request.get("seed") is float:
		if request["seed"] > LARGEST_SEED:
			push_error("%s/seed: write a seed above 2^53 as a text" % path)
			return {}
		request["seed"] = int(request["seed"])
	var output: Dictionary = request.get("output", {})
	output["profile"] = "godot"
	output["format"] = "glb"
	request["output"] = output
	return request


## The scene of an answer, or null after its errors. Pictures become textures beside the request file, as those of any glTF file.
func _scene_of(path: String, answer: Service.Answer, flags: int) -> Node:
	for line in answer.errors:
		push_error(path + line)
	if not answer.errors.is_empty():
		return null
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	state.filename = path.get_file().get_basename()
	if document.append_from_buffer(answer.body, path.get_base_dir(), state, flags) != OK:
		push_error("%s: the model could not be read" % path)
		return null
	return document.generate_scene(state)
