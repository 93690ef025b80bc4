# SPDX-License-Identifier: GPL-3.0-or-later
"""Items of dynamic enumerations. Blender keeps only pointers to their texts, so they must live as long as Blender does."""
_kept = {}


def items_of(names):
    key = tuple(names)
    if key not in _kept:
        _kept[key] = [(name, name.replace("_", " ").capitalize(), "") for name in names]
    return _kept[key]
