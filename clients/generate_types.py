#!/usr/bin/env python3
"""Writes the types of both clients from the JSON Schemas and the OpenAPI document.

    clients/generate_types.py           writes both files
    clients/generate_types.py --check   ends with status 1 if a file is not current, and writes nothing

A schema becomes a small tree of types, and two writers print that tree as Python and as TypeScript.
"""
import json
import keyword
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

root = Path(__file__).resolve().parent.parent
schemas = root / "api_schema"
outputs = {"python": root / "clients/python/src/seedmesh/types.py", "typescript": root / "clients/js/src/types.ts"}
notice = "Generated from api_schema by clients/generate_types.py. Do not edit."
longest_tuple = 4


@dataclass
class Atom:
    """any, string, integer, number, boolean or null."""
    name: str


@dataclass
class Literal:
    values: list


@dataclass
class Name:
    name: str


@dataclass
class Array:
    item: object


@dataclass
class Tuple:
    items: list


@dataclass
class Map:
    value: object


@dataclass
class Union:
    options: list


@dataclass
class Member:
    type: object
    text: str
    is_required: bool


@dataclass
class Object:
    text: str
    members: dict = field(default_factory=dict)


def pascal(text):
    """A name in PascalCase; signs that no name can hold separate words."""
    return "".join(word[:1].upper() + word[1:] for word in re.split(r"[^A-Za-z0-9]+", text) if word)


class Reader:
    """Collects named types, those that others use first."""

    def __init__(self):
        self.types = {}
        self.loaded = {}
        self.openapi = json.loads((schemas / "openapi.json").read_text(encoding="utf-8"))

    def load(self, file):
        if file not in self.loaded:
            self.loaded[file] = json.loads((schemas / file).read_text(encoding="utf-8"))
        return self.loaded[file]

    def define(self, name, value):
        if name in self.types and self.types[name] != value:
            raise SystemExit(f"two different types would be called {name}")
        self.types[name] = value
        return Name(name)

    def reference(self, target, file):
        other, _, pointer = target.partition("#")
        other = other or file
        if other == "request.schema.json":
            return Name("Request")
        if not pointer:
            return self.read(self.load(other), other, pascal(other.split(".")[0]))
        if pointer == "/$defs/child":
            return Name("Child")
        document = self.openapi if other == "openapi.json" else self.load(other)
        for key in pointer.strip("/").split("/"):
            document = document[key]
        return self.read(document, other, pascal(pointer.split("/")[-1]), is_shared=True)

    def read(self, schema, file, name, is_shared=False):
        """The type of a schema. `name` names it if it needs a name of its own."""
        if "$ref" in schema:
            return self.reference(schema["$ref"], file)
        for key in ("oneOf", "anyOf"):
            if key in schema:
                options = [self.read(each, file, name + (str(index + 1) if index else ""))
                           for index, each in enumerate(schema[key])]
                return self.shared(Union(options), name, is_shared)
        if "enum" in schema:
            return self.shared(Literal(schema["enum"]), name, is_shared)
        if "const" in schema:
            return Literal([schema["const"]])
        kind = schema.get("type")
        if isinstance(kind, list):
            return Union([self.read({**schema, "type": each}, file, name) for each in kind])
        if kind == "object":
            return self.read_object(schema, file, name)
        if kind == "array":
            return self.read_array(schema, file, name)
        return Atom(kind or "any")

    def shared(self, value, name, is_shared):
        return self.define(name, value) if is_shared else value

    def read_array(self, schema, file, name):
        item = self.read(schema.get("items", {}), file, name + "Item")
        count = schema.get("minItems", -1)
        if count == schema.get("maxItems") and 1 < count <= longest_tuple:
            return Tuple([item] * count)
        return Array(item)

    def read_object(self, schema, file, name):
        if not schema.get("properties"):
            more = schema.get("additionalProperties", True)
            return Map(self.read(more, file, name + "Value") if isinstance(more, dict) else Atom("any"))
        value = Object(schema.get("description", schema.get("title", "")))
        required = schema.get("required", [])
        for key, each in schema["properties"].items():
            value.members[key] = Member(self.read(each, file, name + pascal(key)), each.get("description", ""), key in required)
        return self.define(name, value)


def generators():
    """The generators with a schema, in the order of the alphabet."""
    others = {"common", "output", "problem", "request"}
    return sorted(file.name.split(".")[0] for file in schemas.glob("*.schema.json") if file.name.split(".")[0] not in others)


def request_type(reader, generator, is_child):
    """The request of one generator, or with `generator` None the changes to a preset."""
    properties = reader.load("request.schema.json")["properties"]
    text = {key: each.get("description", "") for key, each in properties.items()}
    seed = reader.reference("common.schema.json#/$defs/seed", "request.schema.json")
    value = Object("A request with this generator." if generator else "A preset, and the changes to it as a JSON Merge Patch (RFC 7396).")
    if generator:
        value.members["generator"] = Member(Literal([generator]), text["generator"], True)
    value.members["preset"] = Member(Atom("string"), text["preset"], generator is None)
    value.members["seed"] = Member(seed, "The seed: the same request with the same seed gives the same bytes.", False)
    parameters = Name(pascal(generator) + "Parameters") if generator else Map(Atom("any"))
    value.members["parameters"] = Member(parameters, text["parameters"], False)
    if not is_child:
        value.members["output"] = Member(Name("Output"), "The form of the response.", False)
    return reader.define(pascal(generator or "preset") + ("Child" if is_child else "Request"), value)


def read_all():
    reader = Reader()
    reader.reference("output.schema.json", "output.schema.json")
    reader.reference("problem.schema.json", "problem.schema.json")
    for generator in generators():
        reader.read(reader.load(f"{generator}.schema.json"), f"{generator}.schema.json", pascal(generator) + "Parameters")
    kinds = [*generators(), None]
    reader.define("Child", Union([request_type(reader, each, is_child=True) for each in kinds]))
    reader.define("Request", Union([request_type(reader, each, is_child=False) for each in kinds]))
    for name, schema in reader.openapi["components"]["schemas"].items():
        if name != "parameters" and not name.endswith("_request"):
            answer = reader.read(schema, "openapi.json", pascal(name))
            if answer != Name(pascal(name)):
                reader.define(pascal(name), answer)
    return reader.types


# --- Python ---------------------------------------------------------------------------------------------------------

python_atoms = {"any": "Any", "string": "str", "integer": "int", "number": "float", "boolean": "bool", "null": "None"}


def python_type(value):
    if isinstance(value, Atom):
        return python_atoms[value.name]
    if isinstance(value, Name):
        return f'"{value.name}"'
    if isinstance(value, Literal):
        return f"Literal[{', '.join(map(repr, value.values))}]"
    if isinstance(value, (Array, Tuple)):
        # JSON arrays are lists: a literal of Python has no fixed length.
        return f"List[{python_type(value.item if isinstance(value, Array) else value.items[0])}]"
    if isinstance(value, Map):
        return f"Dict[str, {python_type(value.value)}]"
    return f"Union[{', '.join(map(python_type, value.options))}]"


def is_python_name(key):
    return key.isidentifier() and not keyword.iskeyword(key)


def python_dict(name, members, bases, is_total):
    """A TypedDict as a class, or as a call if a key is no name of Python."""
    total = "" if is_total else ", total=False"
    if all(map(is_python_name, members)):
        yield f"class {name}({bases}{total}):"
        for key, member in members.items():
            yield f"    {key}: {python_type(member.type)}"
        if not members:
            yield "    pass"
    else:
        yield f'{name} = TypedDict("{name}", {{'
        for key, member in members.items():
            yield f"    {key!r}: {python_type(member.type)},"
        yield f"}}{total})"
    yield ""
    yield ""


def python_children(types):
    """One type for all nested requests, without the types of their parameters: mypy takes minutes over types that contain themselves."""
    members = dict(types["PresetChild"].members)
    members["preset"] = Member(Atom("string"), "", False)
    child = Object("", {"generator": Member(Atom("string"), "", False), **members})
    kinds = {each.name for each in types["Child"].options}
    return {name: child if name == "Child" else value for name, value in types.items() if name not in kinds}


def write_python(types):
    yield f'"""{notice}"""'
    yield "from typing import Any, Dict, List, Literal, TypedDict, Union"
    yield ""
    yield ""
    for name, value in python_children(types).items():
        if not isinstance(value, Object):
            yield f"{name} = {python_type(value)}"
            yield ""
            continue
        required = {key: each for key, each in value.members.items() if each.is_required}
        optional = {key: each for key, each in value.members.items() if not each.is_required}
        if not required or not optional:
            yield from python_dict(name, value.members, "TypedDict", is_total=bool(required))
            continue
        yield from python_dict(f"_{name}Required", required, "TypedDict", is_total=True)
        if all(map(is_python_name, optional)):
            yield from python_dict(name, optional, f"_{name}Required", is_total=False)
        else:
            yield from python_dict(f"_{name}Optional", optional, "TypedDict", is_total=False)
            yield from python_dict(name, {}, f"_{name}Required, _{name}Optional", is_total=True)


# --- TypeScript -----------------------------------------------------------------------------------------------------

typescript_atoms = {"any": "unknown", "string": "string", "integer": "number", "number": "number", "boolean": "boolean", "null": "null"}


def typescript_comment(text):
    return "/** " + text.replace("*/", "*\\/") + " */"


def typescript_type(value):
    if isinstance(value, Atom):
        return typescript_atoms[value.name]
    if isinstance(value, Name):
        return value.name
    if isinstance(value, Literal):
        return " | ".join(json.dumps(each) for each in value.values)
    if isinstance(value, Array):
        item = typescript_type(value.item)
        return f"({item})[]" if " " in item and not item.startswith("{") else f"{item}[]"
    if isinstance(value, Tuple):
        return f"[{', '.join(map(typescript_type, value.items))}]"
    if isinstance(value, Map):
        return f"{{ [key: string]: {typescript_type(value.value)} }}"
    return " | ".join(dict.fromkeys(map(typescript_type, value.options)))


def write_typescript(types):
    yield f"// {notice}"
    for name, value in types.items():
        yield ""
        if not isinstance(value, Object):
            yield f"export type {name} = {typescript_type(value)};"
            continue
        if value.text:
            yield typescript_comment(value.text)
        yield f"export interface {name} {{"
        if name in ("PresetRequest", "PresetChild"):
            yield "  generator?: undefined;"
        for key, member in value.members.items():
            if member.text:
                yield "  " + typescript_comment(member.text)
            shown = key if re.fullmatch(r"[A-Za-z_$][\w$]*", key) else json.dumps(key)
            yield f"  {shown}{'' if member.is_required else '?'}: {typescript_type(member.type)};"
        yield "}"


def main():
    types = read_all()
    texts = {"python": write_python(types), "typescript": write_typescript(types)}
    status = 0
    for language, lines in texts.items():
        text = "\n".join(lines).rstrip("\n") + "\n"
        path = outputs[language]
        is_current = path.exists() and path.read_text(encoding="utf-8") == text
        if "--check" not in sys.argv:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif not is_current:
            print(f"{path.relative_to(root)} is not current: run clients/generate_types.py", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
