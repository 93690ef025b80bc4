"""Runs when the editor starts: adds Tools > Seedmesh > Import request files."""
import unreal

menu = unreal.ToolMenus.get().find_menu("LevelEditor.MainMenu.Tools")
if menu:
    entry = unreal.ToolMenuEntry(name="SeedmeshImport", type=unreal.MultiBlockType.MENU_ENTRY)
    entry.set_label("Seedmesh: import request files")
    entry.set_string_command(unreal.ToolMenuStringCommandType.PYTHON, "", "import seedmesh_unreal; seedmesh_unreal.import_all()")
    menu.add_menu_entry("Seedmesh", entry)
    unreal.ToolMenus.get().refresh_all_widgets()
