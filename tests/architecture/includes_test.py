# SPDX-License-Identifier: Zlib
"""Includes run one way: every #include "..." of the library and the command is one that docs/architecture.md allows.

includes_test.py SOURCE_DIR
"""

import pathlib
import re
import sys

ROW = re.compile(r"^\|([^|]+)\|([^|]*`[^|]*)\|([^|]*)\|$")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


class Layers:
    """The tables: which paths belong to a layer, and which layers it may include."""

    def __init__(self, text):
        self.paths = []  # (prefix, layer)
        self.allowed = {}
        self.errors = []
        for line in text.splitlines():
            row = ROW.match(line)
            if row:
                self.add(row[1].strip(), re.findall(r"`([^`]+)`", row[2]), row[3].replace(",", " ").split())
        self.paths.sort(key=lambda path: -len(path[0]))

    def add(self, layer, prefixes, allowed):
        if layer in self.allowed:
            self.errors.append(f"the layer {layer} has two rows")
        for other in allowed:
            if other not in self.allowed:
                self.errors.append(f"the row of {layer} names {other}, which has no row above it")
        self.allowed[layer] = {layer, *allowed}
        self.paths += [(prefix, layer) for prefix in prefixes]

    def of(self, file):
        return next((layer for prefix, layer in self.paths if file.startswith(prefix)), None)


def errors_of(layers, file, text):
    layer = layers.of(file)
    if layer is None:
        yield f"{file}: belongs to no layer"
        return
    for included in INCLUDE.findall(text):
        other = layers.of(included)
        if other is None:
            yield f'{file}: includes "{included}", which belongs to no layer (a path from the root of the tree is meant)'
        elif other not in layers.allowed[layer]:
            yield f'{file}: includes "{included}", but {layer} may not include {other}'


def check(source_dir):
    page = (source_dir / "docs" / "architecture.md").read_text(encoding="utf-8")
    layers = Layers(page.partition("## Which folder may include which\n")[2])
    errors = list(layers.errors)
    count = 0
    for folder in ("bullet_wetcloth", "command"):
        for path in sorted((source_dir / folder).rglob("*")):
            if path.suffix in (".h", ".cpp", ".in"):
                count += 1
                name = path.relative_to(source_dir).as_posix()
                errors += errors_of(layers, name, path.read_text(encoding="utf-8"))
    if count == 0:
        errors.append(f"there are no sources in {source_dir}")
    return errors


def check_itself():
    """A checker that lets everything pass would never be noticed."""
    table = "| low | `a/` `b/Low.h` | |\n| high | `b/` | low |\n"
    layers = Layers(table)
    assert not layers.errors
    assert not list(errors_of(layers, "b/x.cpp", '#include "a/y.h"\n#include "b/Low.h"\n#include <z>\n'))
    assert "may not include high" in list(errors_of(layers, "a/y.h", '  # include "b/x.h"\n'))[0]
    assert "may not include high" in list(errors_of(layers, "b/Low.h", '#include "b/x.h"\n'))[0]
    assert "no layer" in list(errors_of(layers, "a/y.h", '#include "y.h"\n'))[0]
    assert "no layer" in list(errors_of(layers, "c/y.h", ""))[0]
    assert "no row above" in Layers("| low | `a/` | high |\n| high | `b/` | low |\n").errors[0]


def main():
    check_itself()
    errors = check(pathlib.Path(sys.argv[1]))
    for error in errors:
        print(error)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
