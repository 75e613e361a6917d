# SPDX-License-Identifier: Zlib
"""Poses of the figure: a turn of each joint against its parent, none of them as he stands. Used by make_figure.py.

Functions tell of the left side; the right one does the same, mirrored. Angles in degrees.
"""
import numpy as np

import body
from rotations import about, about_x, about_y, about_z, between, mirrored, share

JOINTS = body.joints()
PLACE = {name: place for name, _, place in JOINTS}
UPRIGHT = about_z(-np.degrees(np.arctan2(body.ANKLE[0] - body.HIP[0], body.HIP[1] - body.ANKLE[1])))  # of the left leg


class Pose:
    def __init__(self, hips=None, turns=None):
        self.hips = PLACE["Hips"] if hips is None else np.asarray(hips, float)
        self.turns = {name: np.eye(3) for name, _, _ in JOINTS} | (turns or {})

    def blended(self, other, part):
        turns = {name: between(turn, other.turns[name], part) for name, turn in self.turns.items()}
        return Pose(self.hips + part * (other.hips - self.hips), turns)

    def world(self):
        """Turn and place of each joint in the world."""
        known = {}
        for name, parent, place in JOINTS:
            if parent is None:
                known[name] = (self.turns[name], self.hips)
            else:
                turn, origin = known[parent]
                known[name] = (turn @ self.turns[name], origin + turn @ (place - PLACE[parent]))
        return known

    def parts(self):
        """Spheres of each part in the world: (joint, centres, radii)."""
        world = self.world()
        moved = lambda joint, centres: (centres - PLACE[joint]) @ world[joint][0].T + world[joint][1]
        return [(joint, moved(joint, centres), radii) for joint, centres, radii in body.parts()]

    def lowest(self):
        """Height [m] of the lowest point of the feet."""
        return min(np.min(centres[:, 1] - radii) for joint, centres, radii in self.parts() if joint.endswith("Foot"))

    def on_ground(self):
        return Pose(self.hips - [0, self.lowest(), 0], self.turns)


def both(turns_of_left):
    """The same on both sides."""
    return one_side("Left", turns_of_left) | one_side("Right", turns_of_left)


def one_side(side, turns_of_left):
    put = (lambda turn: turn) if side == "Left" else mirrored
    return {side + joint: put(turn) for joint, turn in turns_of_left.items()}


def arm(out, forwards=0.0, inwards=0.0, elbow=0.0):
    """`out` from hanging straight down, 45 as he stands; forwards; turned inwards about its length; bent."""
    upper = about_x(-forwards) @ about_z(out - 45) @ about(body.ARM, inwards)
    return {"Arm": upper, "ForeArm": about(np.cross(body.ARM, (0, 0, 1)), elbow)}


def leg(pelvis, flexion, adduction, rotation, knee, ankle):
    """Of the left leg; the foot keeps level from side to side, as the joint below the ankle would have it.

    pelvis: its turn in the world, seen as the left side's (mirrored for the right leg).
    """
    thigh = about_x(-flexion) @ about_z(-adduction) @ about_y(-rotation) @ UPRIGHT
    shin = about(UPRIGHT.T @ (1, 0, 0), knee)
    above = pelvis @ thigh @ shin
    ahead = above @ UPRIGHT.T @ about_x(-ankle) @ (0, 0, 1)
    foot = about_y(np.degrees(np.arctan2(ahead[0], ahead[2]))) @ about_x(-np.degrees(np.arcsin(ahead[1])))
    return {"UpLeg": thigh, "Leg": shin, "Foot": above.T @ foot}


def frame(first, second):
    """Axes along `first`, and across it as near to `second` as can be."""
    first = first / np.linalg.norm(first)
    second = second - first * (first @ second)
    second = second / np.linalg.norm(second)
    return np.stack([first, second, np.cross(first, second)], axis=1)


def leg_to(pelvis, hips, ankle, knees_out):
    """The left leg whose foot stands flat with its ankle at a place [m]; the knee points ahead and a little out."""
    hip = hips + pelvis @ (body.HIP - PLACE["Hips"])
    upper, lower = np.linalg.norm(body.KNEE - body.HIP), np.linalg.norm(body.ANKLE - body.KNEE)
    reach = np.linalg.norm(ankle - hip)
    along = (ankle - hip) / reach
    share_of_upper = (upper**2 - lower**2 + reach**2) / (2 * reach)
    aside = frame(along, about_y(knees_out) @ (0, 0, 1))[:, 1]
    knee = hip + share_of_upper * along + np.sqrt(max(0.0, upper**2 - share_of_upper**2)) * aside
    hinge, hinge_at_rest = np.cross(hip - knee, ankle - knee), np.cross(body.HIP - body.KNEE, body.ANKLE - body.KNEE)
    thigh = frame(knee - hip, hinge) @ frame(body.KNEE - body.HIP, hinge_at_rest).T
    shin = frame(ankle - knee, hinge) @ frame(body.ANKLE - body.KNEE, hinge_at_rest).T
    return {"UpLeg": pelvis.T @ thigh, "Leg": thigh.T @ shin, "Foot": shin.T}


def trunk(pelvis, chest, head):
    """Turns of the trunk's joints from those of pelvis, chest and head in the world."""
    back = pelvis.T @ chest
    neck = chest.T @ head
    return {"Hips": pelvis, "Spine": share(back, 0.5), "Chest": share(back, 0.5), "Neck": share(neck, 0.5), "Head": share(neck, 0.5)}
