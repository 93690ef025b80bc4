@tool
extends VBoxContainer
## The gallery with a picture of the selected preset. A button writes a request file into the project, which the importer makes into
## a scene.

const Service := preload("service.gd")

var filter := LineEdit.new()
var list := ItemList.new()
var picture := TextureRect.new()
var seed_box := SpinBox.new()
var presets: Array = []


func _ready() -> void:
	var load_button := Button.new()
	load_button.text = "Load gallery"
	load_button.pressed.connect(load_gallery)
	filter.placeholder_text = "Filter"
	filter.text_changed.connect(func(_text: String) -> void: show_presets())
	list.size_flags_vertical = Control.SIZE_EXPAND_FILL
	list.item_selected.connect(show_picture)
	picture.custom_minimum_size = Vector2(160, 160)
	picture.stretch_mode = TextureRect.STRETCH_KEEP_ASPECT_CENTERED
	picture.expand_mode = TextureRect.EXPAND_IGNORE_SIZE
	seed_box.max_value = 1 << 31
	seed_box.prefix = "Seed"
	var add_button := Button.new()
	add_button.text = "Add request file"
	add_button.pressed.connect(add_request_file)
	for control: Control in [load_button, filter, list, picture, seed_box, add_button]:
		add_child(control)


func load_gallery() -> void:
	var answer: Variant = Service.get_json("/v1/presets")
	if answer is Dictionary:
		presets = answer["presets"]
		show_presets()


func show_presets() -> void:
	list.clear()
	for preset: Dictionary in presets:
		if filter.text.is_empty() or filter.text.to_lower() in (preset["title"] + preset["generator"]).to_lower():
			var index := list.add_item(preset["title"])
			list.set_item_tooltip(index, preset["description"])
			list.set_item_metadata(index, preset["name"])


func show_picture(index: int) -> void:
	var answer := Service.get_bytes("/v1/presets/%s.webp?size=320&seed=%d" % [list.get_item_metadata(index), int(seed_box.value)])
	var image := Image.new()
	if answer.errors.is_empty() and image.load_webp_from_buffer(answer.body) == OK:
		picture.texture = ImageTexture.create_from_image(image)
	else:
		picture.texture = null


func add_request_file() -> void:
	for index in list.get_selected_items():
		var preset: String = list.get_item_metadata(index)
		var path := "res://%s_%d.seedmesh" % [preset, int(seed_box.value)]
		var file := FileAccess.open(path, FileAccess.WRITE)
		file.store_string(JSON.stringify({"preset": preset, "seed": int(seed_box.value)}) + "\n")
		file.close()
	EditorInterface.get_resource_filesystem().scan()
