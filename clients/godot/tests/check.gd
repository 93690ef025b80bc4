extends SceneTree
## Prints what became of the request files of a project, and of models that are grown at run time, as one line of JSON.
##   godot --headless --path PROJECT --script res://check.gd

const Runtime := preload("res://addons/seedmesh/runtime.gd")
const Dock := preload("res://addons/seedmesh/dock.gd")


func _initialize() -> void:
	var result := {"oak": _described(load("res://oak.seedmesh").instantiate()), "house": _described(load("res://house.seedmesh").instantiate())}
	var holder := Node3D.new()
	root.add_child(holder)
	await process_frame
	result["grown"] = _described(await Runtime.grow(holder, {"preset": "birch", "seed": 7, "output": {"collision": "godot"}}))
	result["refused"] = await Runtime.grow(holder, {"preset": "oakk"}) == null
	result["planted"] = _planted(await Runtime.plant(holder, {"preset": "orchard"}))
	var place := {"translation": [1, 2, 3], "rotation": [0, sqrt(0.5), 0, sqrt(0.5)], "scale": [2, 2, 2]}
	var moved := Runtime.transform_of(place) * Vector3(1, 0, 0)  # a quarter turn about the vertical, twice as large
	result["moved"] = [moved.x, moved.y, moved.z]
	var dock: Control = Dock.new()
	root.add_child(dock)
	dock.load_gallery()
	result["gallery"] = dock.list.item_count
	dock.filter.text = "weeping willow"
	dock.show_presets()
	result["filtered"] = dock.list.item_count
	dock.show_picture(0)
	result["picture"] = dock.picture.texture.get_width()
	dock.free()
	holder.free()
	print("RESULT " + JSON.stringify(result))
	quit()


func _described(scene: Node) -> Dictionary:
	var meshes := []
	for mesh: MeshInstance3D in scene.find_children("*", "MeshInstance3D", true, false):
		var triangles := 0
		for surface in mesh.mesh.get_surface_count():
			triangles += mesh.mesh.surface_get_arrays(surface)[Mesh.ARRAY_INDEX].size() / 3
		var material: BaseMaterial3D = mesh.mesh.surface_get_material(0)
		meshes.append({
			"path": str(scene.get_path_to(mesh)), "triangles": triangles, "begin": mesh.visibility_range_begin, "end": mesh.visibility_range_end,
			"margin": mesh.visibility_range_end_margin,
			"texture": material.albedo_texture.get_class() if material.albedo_texture else "",
		})
	# The root of a file with GODOT_single_root is the body.
	var bodies := scene.find_children("*", "StaticBody3D", true, false).size() + (1 if scene is StaticBody3D else 0)
	var shapes := scene.find_children("*", "CollisionShape3D", true, false).size()
	scene.free()
	return {"meshes": meshes, "bodies": bodies, "shapes": shapes}


func _planted(scene: Node) -> Dictionary:
	var counts := []
	for copies: MultiMeshInstance3D in scene.get_children():
		counts.append(copies.multimesh.instance_count)
	scene.free()
	return {"counts": counts}
