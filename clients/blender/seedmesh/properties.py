# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of the panel. Parameters come from the schema of the generator, so the add-on names none."""
import json

import bpy

from .enums import items_of


def _choices(self, _context):
    return items_of(json.loads(self.choices))


class SeedmeshParameter(bpy.types.PropertyGroup):
    """One parameter: `kind` selects which of the values holds it. It is sent only if `is_given`."""
    title: bpy.props.StringProperty()
    text: bpy.props.StringProperty()
    group: bpy.props.StringProperty()
    kind: bpy.props.StringProperty()
    choices: bpy.props.StringProperty(default="[]")
    is_given: bpy.props.BoolProperty(name="Set", description="Sends this parameter; otherwise the preset decides")
    value_integer: bpy.props.IntProperty(name="")
    value_number: bpy.props.FloatProperty(name="", precision=4)
    value_boolean: bpy.props.BoolProperty(name="")
    value_string: bpy.props.StringProperty(name="")
    value_enum: bpy.props.EnumProperty(name="", items=_choices)

    def value(self):
        return getattr(self, "value_" + self.kind)


class SeedmeshError(bpy.types.PropertyGroup):
    pointer: bpy.props.StringProperty()
    message: bpy.props.StringProperty()


class SeedmeshPreset(bpy.types.PropertyGroup):
    title: bpy.props.StringProperty()
    generator: bpy.props.StringProperty()
    text: bpy.props.StringProperty()


class SeedmeshSettings(bpy.types.PropertyGroup):
    presets: bpy.props.CollectionProperty(type=SeedmeshPreset)
    preset_index: bpy.props.IntProperty(name="Preset")
    preset: bpy.props.StringProperty(name="Preset", default="oak")
    picture: bpy.props.StringProperty()  # the name of the picture of the model, in pictures.py
    seed: bpy.props.IntProperty(name="Seed", min=0, default=0)
    lods: bpy.props.IntProperty(name="Levels of detail", min=1, max=5, default=1)
    collision: bpy.props.BoolProperty(name="Collision bodies")
    animation: bpy.props.BoolProperty(name="Growth animation")
    parameters: bpy.props.CollectionProperty(type=SeedmeshParameter)
    generator: bpy.props.StringProperty()
    errors: bpy.props.CollectionProperty(type=SeedmeshError)
    count: bpy.props.IntProperty(name="Copies", min=1, max=10000, default=20)
    is_busy: bpy.props.BoolProperty()

    def request(self):
        """The request of the panel."""
        output = {"profile": "blender"}
        if self.lods > 1:
            output.update(format="zip", lods=self.lods)
        if self.collision:
            output["collision"] = "plain"
        if self.animation:
            output["animation"] = "growth"
        parameters = {each.name: each.value() for each in self.parameters if each.is_given}
        request = {"preset": self.preset, "seed": self.seed, "output": output}
        return {**request, "parameters": parameters} if parameters else request

    def show_error(self, error):
        """Each error of a refusal with its pointer; any other exception as one line."""
        self.errors.clear()
        for each in getattr(error, "errors", None) or [{"pointer": "", "message": str(error)}]:
            row = self.errors.add()
            row.pointer, row.message = each["pointer"], each["message"]

    def read_schema(self, generator, schema, request):
        """One row for each parameter that is a number, a text, a truth value or a choice; with the values of the preset."""
        self.parameters.clear()
        self.generator = generator
        given = request.get("parameters", {})
        for name, each in schema["properties"].items():
            kind = "enum" if "enum" in each else each.get("type")
            if kind not in ("integer", "number", "boolean", "string", "enum"):
                continue
            row = self.parameters.add()
            row.name, row.kind = name, kind
            row.title, row.text, row.group = each.get("title", name), each.get("description", ""), each.get("x-group", "")
            if kind == "enum":
                row.choices = json.dumps(each["enum"])
            value = given.get(name, each.get("default"))
            if value is not None:
                setattr(row, "value_" + kind, value)


classes = (SeedmeshParameter, SeedmeshError, SeedmeshPreset, SeedmeshSettings)
