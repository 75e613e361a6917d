# SPDX-License-Identifier: Zlib
"""Cloth that gets wet, on Bullet: scenes of the command `wetcloth`, stepped from Python.

    import wetcloth

    scene = wetcloth.open("hanging_towel.json")
    towel = scene.cloths[0]
    scene.step(60)
    print(towel.positions.mean(axis=0), towel.water.sum())

Arrays are NumPy's, in SI units, one row for each node.
"""

import importlib
import json
import os
import pathlib
import warnings

from wetcloth.errors import InputError, RunError, StateError

__all__ = ["InputError", "RunError", "StateError", "open", "scene_folder"]
__version__ = "@PROJECT_VERSION@"

_loaded = None  # of the modules that there are, one for each precision


def scene_folder():
    """The folder of the scenes that go with the package, a pathlib.Path."""
    return (pathlib.Path(__file__).parent / "@WETCLOTH_PYTHON_TO_SCENES@").resolve()


def open(scene, precision=None):
    """Opens a scene: a file, the name of one in scene_folder(), or a dictionary of what such a file holds.

    precision is "float32" or "float64"; None: as the scene says. One process has one of them, as Bullet's libraries of
    both share names: start another process for the other (multiprocessing).

    Raises InputError for a scene that is not allowed, and RuntimeError for a second precision.
    """
    if isinstance(scene, dict):
        module = _module(precision or scene.get("precision", "float32"))
        opened = module.open_description(scene, "scene")
    else:
        file = _found(os.fsdecode(scene))
        opened = _module(precision or _precision_in(file)).open_file(file)
    for hint in opened._hints:
        warnings.warn(hint, stacklevel=2)
    return opened


def _found(name):
    """Which file a name means: as for the command, one without a folder may be one of ours."""
    if os.path.dirname(name) or os.path.exists(name):
        return name
    ours = scene_folder() / name
    return str(ours) if ours.is_file() else name


def _precision_in(file):
    """What the file says; whether it may say that is for its reader to tell."""
    try:
        return json.loads(pathlib.Path(file).read_text(encoding="utf-8")).get("precision", "float32")
    except (OSError, ValueError, AttributeError):
        return "float32"


def _module(precision):
    global _loaded
    if _loaded is not None and _loaded[0] == precision:
        return _loaded[1]
    if precision not in ("float32", "float64"):
        raise InputError(f'precision = {precision!r}: must be "float32" or "float64"')
    if _loaded is not None:
        raise RuntimeError(f"this process has scenes in {_loaded[0]}, and one in {precision} needs another process")
    try:
        _loaded = precision, importlib.import_module(f"wetcloth._{precision}")
    except ModuleNotFoundError as missing:
        raise RuntimeError(f"this build of wetcloth is without {precision}") from missing
    return _loaded[1]
