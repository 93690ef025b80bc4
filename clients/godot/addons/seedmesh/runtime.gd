class_name Seedmesh
extends RefCounted
## Models and placement lists in a running game.
##
##     add_child(await Seedmesh.grow(self, {"preset": "oak", "seed": 7}))


## The scene of a request, or null after an error, which is in the log. `owner` is any node inside the tree.
static func grow(owner: Node, request: Dictionary) -> Node:
	var asked := request.duplicate(true)
	asked["output"] = asked.get("output", {}).merged({"profile": "godot", "format": "glb"}, true)
	var body := await _post(owner, "/v1/generate", asked)
	if body.is_empty():
		return null
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_buffer(body, "", state) != OK:
		push_error("Seedmesh: the model could not be read")
		return null
	var scene := document.generate_scene(state)
	for hull: Node in scene.find_children("*-convcolonly", "MeshInstance3D", true, false):
		_replace_by_body(hull as MeshInstance3D)
	return scene


## The models of a scene request, one MultiMeshInstance3D for each mesh of each model.
static func plant(owner: Node, request: Dictionary) -> Node3D:
	var body := await _post(owner, "/v1/derive", request)
	if body.is_empty():
		return null
	var derived: Dictionary = JSON.parse_string(body.get_string_from_utf8())
	var root := Node3D.new()
	for model: String in derived["models"]:
		var scene := await grow(owner, derived["models"][model])
		if scene == null:
			continue
		var transforms: Array[Transform3D] = []
		for placement: Dictionary in derived["placements"]:
			if placement["model"] == model:
				transforms.append(transform_of(placement))
		for mesh: MeshInstance3D in scene.find_children("*", "MeshInstance3D", true, false):
			root.add_child(_copies(mesh, _transform_in(mesh, scene), transforms))
		scene.free()
	return root


## Only the editor's import reads suffixes of names, so collision bodies are set up here.
static func _replace_by_body(hull: MeshInstance3D) -> void:
	var body := StaticBody3D.new()
	body.name = hull.name.trim_suffix("-convcolonly")
	body.transform = hull.transform
	var shape := CollisionShape3D.new()
	shape.shape = hull.mesh.create_convex_shape()
	body.add_child(shape)
	hull.get_parent().add_child(body)
	hull.free()


## Where a placement of a scene puts its model.
static func transform_of(placement: Dictionary) -> Transform3D:
	var t: Array = placement["translation"]
	var r: Array = placement["rotation"]
	var s: Array = placement["scale"]
	var basis := Basis(Quaternion(r[0], r[1], r[2], r[3])).scaled_local(Vector3(s[0], s[1], s[2]))
	return Transform3D(basis, Vector3(t[0], t[1], t[2]))


## The transform of a node relative to the root of its scene, which is not inside the tree.
static func _transform_in(node: Node3D, root: Node) -> Transform3D:
	var all := node.transform
	var parent := node.get_parent()
	while parent != root and parent is Node3D:
		all = parent.transform * all
		parent = parent.get_parent()
	return all


static func _copies(mesh: MeshInstance3D, inside: Transform3D, transforms: Array[Transform3D]) -> MultiMeshInstance3D:
	var copies := MultiMesh.new()
	copies.transform_format = MultiMesh.TRANSFORM_3D
	copies.mesh = mesh.mesh
	copies.instance_count = transforms.size()
	for index in transforms.size():
		copies.set_instance_transform(index, transforms[index] * inside)
	var node := MultiMeshInstance3D.new()
	node.multimesh = copies
	node.name = mesh.name
	return node


static func _post(owner: Node, target: String, request: Dictionary) -> PackedByteArray:
	var http := HTTPRequest.new()
	owner.add_child(http)
	var headers: PackedStringArray = ["Content-Type: application/json"]
	var key: String = ProjectSettings.get_setting("seedmesh/key", "")
	if key:
		headers.append("Authorization: Bearer " + key)
	var server: String = ProjectSettings.get_setting("seedmesh/server", "http://127.0.0.1:8080")
	http.request(server + target, headers, HTTPClient.METHOD_POST, JSON.stringify(request))
	var answer: Array = await http.request_completed
	http.queue_free()
	var body: PackedByteArray = answer[3]
	if answer[1] != 200:
		push_error("Seedmesh: status %d: %s" % [answer[1], body.get_string_from_utf8()])
		return PackedByteArray()
	return body
