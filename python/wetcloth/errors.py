# SPDX-License-Identifier: Zlib
"""What goes wrong, with the same text as the command `wetcloth` prints."""


class InputError(ValueError):
    """A scene or a parameter that is not allowed: the text names file, place, value and what is allowed."""


class RunError(RuntimeError):
    """A run that cannot go on: a cloth has blown up."""


class StateError(ValueError):
    """Bytes that are no saved state of this scene, or what cannot be saved."""
