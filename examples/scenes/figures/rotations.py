# SPDX-License-Identifier: Zlib
"""Turns about axes, as matrices; used by make_figure.py."""
import numpy as np
from scipy.spatial.transform import Rotation


def about(axis, degrees):
    axis = np.asarray(axis, float)
    return Rotation.from_rotvec(np.radians(degrees) * axis / np.linalg.norm(axis)).as_matrix()


def about_x(degrees):
    return about((1, 0, 0), degrees)


def about_y(degrees):
    return about((0, 1, 0), degrees)


def about_z(degrees):
    return about((0, 0, 1), degrees)


def share(turn, part):
    """A part, 0 to 1, of a turn."""
    return Rotation.from_rotvec(part * Rotation.from_matrix(turn).as_rotvec()).as_matrix()


def between(first, second, part):
    return first @ share(first.T @ second, part)


def mirrored(turn):
    """What the right side does when the left one does this."""
    flip = np.diag([-1.0, 1, 1])
    return flip @ turn @ flip


def angles_zxy(turn):
    """Degrees a, b, c with turn = about_z(a) about_x(b) about_y(c)."""
    return Rotation.from_matrix(turn).as_euler("ZXY", degrees=True)
