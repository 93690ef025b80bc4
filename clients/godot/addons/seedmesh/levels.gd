@tool
extends EditorScenePostImportPlugin
## Levels of detail by distance. Godot makes levels of its own for closed meshes, but none for leaves, which are many small cards.

## Shares of the triangles for a number of levels.
const SHARES: Array[float] = [1.0, 0.4, 0.15, 0.05, 0.02]
## Shares of the picture's height below which the coarser levels of such a number begin, as in models of the service. Those of a list
## follow from the triangles: the root of the share of the finest level.
const SCREEN: Array[float] = [0.5, 0.25, 0.12, 0.06]
const HALF_FIELD := deg_to_rad(75.0) / 2.0  # of the default camera
const NOTE := "seedmesh_level_ends"
const NODE := "level_%d"
## A coarser level is left where the model has grown by the factor 1 + HYSTERESIS in the picture.
const HYSTERESIS := 0.1
## Godot changes to a coarser level at the range plus its margin, and back at the range less its margin.
const MIDDLE := 0.5 * (1.0 + 1.0 / (1.0 + HYSTERESIS))
const MARGIN := 0.5 * (1.0 - 1.0 / (1.0 + HYSTERESIS))


## Triangles of each level. `lods`: a number of levels, or a list of shares and numbers of triangles, of which the first stands for
## the model itself.
static func triangles_of(lods: Variant, finest: int) -> Array[int]:
	var wanted: Array = lods if lods is Array else SHARES.slice(0, clampi(int(lods), 1, SHARES.size()))
	var triangles: Array[int] = [finest]
	for each: float in wanted.slice(1):
		triangles.append(maxi(int(each * finest) if each <= 1.0 else int(each), 1))
	return triangles


## Puts coarser scenes below the root of the first. The distances are notes on that root until the import is done, because Godot
## does not keep those of meshes that it imports. `lods` is what the request asks for.
static func join(levels: Array[Node], triangles: Array[int], lods: Variant) -> void:
	var root := levels[0]
	var size := _size_of(root)
	var ends: Array[float] = []
	for index in range(1, levels.size()):
		var screen := sqrt(float(triangles[index]) / triangles[0]) if lods is Array else SCREEN[index - 1]
		ends.append(size / (2.0 * tan(HALF_FIELD) * screen))
	for index in range(1, levels.size()):
		levels[index].name = NODE % index
		root.add_child(levels[index])
		_own(levels[index], root)
	root.set_meta(NOTE, ends)


## Lets each mesh be seen at the distances of its level.
func _post_process(scene: Node) -> void:
	if not scene.has_meta(NOTE):
		return
	var ends: Array = scene.get_meta(NOTE)
	scene.remove_meta(NOTE)
	var coarser: Array[Node] = []
	for index in range(1, ends.size() + 1):
		coarser.append(scene.get_node(NODE % index))
	for mesh: MeshInstance3D in scene.find_children("*", "MeshInstance3D", true, false):
		var level := 0
		for index in coarser.size():
			if coarser[index].is_ancestor_of(mesh):
				level = index + 1
		if level > 0:
			mesh.visibility_range_begin = ends[level - 1] * MIDDLE
			mesh.visibility_range_begin_margin = ends[level - 1] * MARGIN
		if level < ends.size():
			mesh.visibility_range_end = ends[level] * MIDDLE
			mesh.visibility_range_end_margin = ends[level] * MARGIN


static func _own(node: Node, root: Node) -> void:
	node.owner = root
	for child in node.get_children():
		_own(child, root)


## The longest side of the box around all vertices.
static func _size_of(root: Node) -> float:
	var box := AABB()
	for node: Node in root.find_children("*", "ImporterMeshInstance3D", true, false):
		var mesh: ImporterMesh = node.get("mesh")
		for surface in mesh.get_surface_count():
			var points: PackedVector3Array = mesh.get_surface_arrays(surface)[Mesh.ARRAY_VERTEX]
			for point in points:
				box = box.expand(point)
	return box.get_longest_axis_size()
