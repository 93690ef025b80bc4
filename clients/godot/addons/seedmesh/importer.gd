@tool
extends EditorSceneFormatImporter
## Imports a request file as a scene. The importer is selected by the last extension, which is why request files have one of their own.

const Service := preload("service.gd")

## Members of a request file that the service does not know.
const OWN_MEMBERS: PackedStringArray = ["$schema", "name", "outputs"]


func _get_extensions() -> PackedStringArray:
	return ["seedmesh"]


func _import_scene(path: String, flags: int, _options: Dictionary) -> Object:
	var reader := JSON.new()
	if reader.parse(FileAccess.get_file_as_string(path)) != OK:
		push_error("%s:%d: %s" % [path, reader.get_error_line() + 1, reader.get_error_message()])
		return null
	if not reader.data is Dictionary:
		push_error("%s: expected an object" % path)
		return null
	var request: Dictionary = reader.data
	for member in OWN_MEMBERS:
		request.erase(member)
	# JSON numbers arrive as floats; the service expects a whole seed.
	if request.get("seed") is float:
		request["seed"] = int(request["seed"])
	var output: Dictionary = request.get("output", {})
	output["profile"] = "godot"
	output["format"] = "glb"
	output.erase("lods")  # Godot makes levels of its own
	request["output"] = output
	var answer := Service.post("/v1/generate", request)
	for line in answer.errors:
		push_error(path + line)
	if not answer.errors.is_empty():
		return null
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_buffer(answer.body, "", state, flags) != OK:
		push_error("%s: the model could not be read" % path)
		return null
	return document.generate_scene(state)
