"""Where each value of a JSON text begins, by JSON Pointer (RFC 6901), so that an error names a line of the file."""
import json
import re
from json.decoder import scanstring  # type: ignore[attr-defined]
from typing import Any, Dict, Tuple

_space = re.compile(r"[ \t\n\r]*")
_scalar = re.compile(r"[^\s,\]}]+")


def token_of(name: str) -> str:
    """A name as a token of a JSON Pointer."""
    return name.replace("~", "~0").replace("/", "~1")


class Positions:
    """Reads a text that json.loads accepts."""

    def __init__(self, text: str):
        self.text = text
        self.starts: Dict[str, int] = {}
        self._value(self._skip(0), "")

    def of(self, pointer: str) -> Tuple[int, int]:
        """Line and column, from 1, of the value; of the object around it if the text has no such value."""
        while pointer not in self.starts and pointer:
            pointer = pointer.rpartition("/")[0]
        return line_and_column(self.text, self.starts.get(pointer, 0))

    def _skip(self, index: int) -> int:
        match = _space.match(self.text, index)
        return match.end() if match else index

    def _value(self, index: int, pointer: str) -> int:
        self.starts[pointer] = index
        sign = self.text[index]
        if sign == '"':
            return int(scanstring(self.text, index + 1, True)[1])
        if sign not in "[{":
            match = _scalar.match(self.text, index)
            return match.end() if match else index
        count = 0
        index = self._skip(index + 1)
        while self.text[index] not in "]}":
            name = str(count)
            if sign == "{":
                begin = index
                name, index = scanstring(self.text, index + 1, True)
                name = token_of(name)
                if f"{pointer}/{name}" in self.starts:
                    raise json.JSONDecodeError(f'the key "{name}" is given twice', self.text, begin)
                index = self._skip(self._skip(index) + 1)
            index = self._skip(self._value(index, f"{pointer}/{name}"))
            if self.text[index] == ",":
                index = self._skip(index + 1)
            count += 1
        return index + 1


def line_and_column(text: str, index: int) -> Tuple[int, int]:
    return text.count("\n", 0, index) + 1, index - text.rfind("\n", 0, index)


def _refuse(name: str) -> Any:
    raise ValueError(f"found {name}, which is no JSON number")


def parse(text: str) -> Any:
    """The value of a JSON text. json.JSONDecodeError with the position; ValueError for NaN, infinity and deep nesting."""
    try:
        value = json.loads(text, parse_constant=_refuse)
        Positions(text)
    except RecursionError:
        raise ValueError("the file is nested too deep") from None
    return value
