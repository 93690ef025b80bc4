@tool
extends EditorPlugin
## Saves a picture of the editor as res://editor.png, and ends it. Needs a window, and a project with main.tscn and oak.seedmesh:
##   xvfb-run -s "-screen 0 1280x800x24" godot --path PROJECT --rendering-driver opengl3 --resolution 1280x800 --editor main.tscn


func _enter_tree() -> void:
	_draw()


func _draw() -> void:
	await get_tree().create_timer(8).timeout
	var base := EditorInterface.get_base_control()
	base.get_window().mode = Window.MODE_FULLSCREEN
	for dock: Node in base.find_children("Seedmesh", "VBoxContainer", true, false):
		_show_tab(dock)
		dock.call("load_gallery")
		var list: ItemList = dock.get("list")
		for index in list.item_count:
			if list.get_item_metadata(index) == "oak":
				list.select(index)
				list.ensure_current_is_visible()
				dock.call("show_picture", index)
	EditorInterface.set_main_screen_editor("3D")
	EditorInterface.edit_node(EditorInterface.get_edited_scene_root().get_node("Oak"))
	await get_tree().create_timer(2).timeout
	var middle := Vector2(640, 430)
	for step in 11:  # the wheel of the mouse moves the camera away
		for pressed: bool in [true, false]:
			var wheel := InputEventMouseButton.new()
			wheel.button_index = MOUSE_BUTTON_WHEEL_DOWN
			wheel.position = middle
			wheel.global_position = middle
			wheel.pressed = pressed
			Input.parse_input_event(wheel)
		await get_tree().process_frame
	EditorInterface.get_selection().clear()
	await get_tree().create_timer(6).timeout
	base.get_viewport().get_texture().get_image().save_png("res://editor.png")
	get_tree().quit()


## Selects the tab that a node is in.
func _show_tab(node: Node) -> void:
	var page := node
	while page != null and not page.get_parent() is TabContainer:
		page = page.get_parent()
	if page != null:
		(page.get_parent() as TabContainer).current_tab = page.get_index()
