@tool
extends EditorPlugin
## Registers the importer of request files and the dock with the gallery.

const Importer := preload("importer.gd")
const Levels := preload("levels.gd")
const Dock := preload("dock.gd")

var importer: EditorSceneFormatImporter
var levels: EditorScenePostImportPlugin
var dock: Control


func _enter_tree() -> void:
	_add_setting("seedmesh/server", "http://127.0.0.1:8080")
	_add_setting("seedmesh/key", "")
	importer = Importer.new()
	add_scene_format_importer_plugin(importer)
	levels = Levels.new()
	add_scene_post_import_plugin(levels)
	dock = Dock.new()
	dock.name = "Seedmesh"
	add_control_to_dock(DOCK_SLOT_LEFT_BR, dock)


func _exit_tree() -> void:
	remove_scene_format_importer_plugin(importer)
	importer = null
	remove_scene_post_import_plugin(levels)
	levels = null
	remove_control_from_docks(dock)
	dock.free()


func _add_setting(path: String, value: String) -> void:
	if not ProjectSettings.has_setting(path):
		ProjectSettings.set_setting(path, value)
	ProjectSettings.set_initial_value(path, value)
