# SPDX-License-Identifier: Zlib
"""The figure's motions: its pose at each time. Used by make_figure.py.

Each begins with the figure as it stands (arms 45 degrees out) and leaves that pose at rest.
"""
import pathlib

import numpy as np

import body
from poses import PLACE, Pose, arm, both, leg, leg_to, one_side, trunk
from rotations import about_x, about_y, about_z, mirrored

STAND = Pose()
CYCLE = 32 / 30  # s, of two steps

# No table of the arms' angles was found. Ranges instead: the shoulder's 24.6 degrees ("Kinematic parameters of movement at the
# shoulder joint in normal gait in humans", abstract, ten men), the elbow's 29.7 (doi 10.5397/cise.2023.00101, abstract).
SHOULDER_SWING, ELBOW_SWING = 24.6 / 2, 29.7 / 2


def smooth(share):
    """From 0 to 1 with no speed at the ends."""
    share = np.clip(share, 0, 1)
    return share * share * (3 - 2 * share)


def pulse(time, rise, hold, fall):
    """From 0 to 1, held, and back."""
    return smooth(time / rise) * (1 - smooth((time - rise - hold) / fall))


class Gait:
    """Curves of a cycle, smoothed to their first harmonics."""

    HARMONICS = 7

    def __init__(self):
        file = pathlib.Path(__file__).with_name("walk_normal_opensim.csv")
        lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
        table = np.array([[float(word) for word in line.split(",")[1:]] for line in lines[1:]])
        names = [name.removesuffix("_deg") for name in lines[0].split(",")[1:]]
        self.samples = len(table)
        self.waves = dict(zip(names, (np.fft.rfft(table, axis=0) / self.samples)[: self.HARMONICS + 1].T))

    def __call__(self, name, phase):
        turning = np.exp(2j * np.pi * phase * np.arange(self.HARMONICS + 1))
        weights = np.where(np.arange(self.HARMONICS + 1) == 0, 1, 2)
        return float(np.sum(weights * (self.waves[name] * turning).real))

    def even(self, name, phase):
        """What both sides do alike, whichever steps."""
        return (self(name, phase) + self(name, phase + 0.5)) / 2

    def odd(self, name, phase):
        """What turns round with the side that steps."""
        return (self(name, phase) - self(name, phase + 0.5)) / 2


GAIT = Gait()


def walking(phase):
    """On the spot, the right heel down at phase 0; the chest keeps straight, as in the measured walk."""
    pelvis = (about_x(-GAIT.even("pelvis_tilt", phase)) @ about_z(GAIT.odd("pelvis_list", phase))
              @ about_y(GAIT.odd("pelvis_rotation", phase)))
    turns = trunk(pelvis, np.eye(3), np.eye(3))
    for side, own, seen in (("Left", phase + 0.5, pelvis), ("Right", phase, mirrored(pelvis))):
        swing = np.cos(2 * np.pi * (own + 0.5))  # ahead with the other leg
        late = np.cos(2 * np.pi * (own + 0.45))
        turns |= one_side(side, arm(out=16, forwards=SHOULDER_SWING * swing - 3, inwards=25, elbow=8 + ELBOW_SWING * (1 + late)))
        names = ("hip_flexion", "hip_adduction", "hip_rotation", "knee_flexion", "ankle_dorsiflexion")
        turns |= one_side(side, leg(seen, *(GAIT(name, own) for name in names)))
    sway = -0.02 * np.cos(2 * np.pi * (phase - 0.3))  # over the foot that stands
    return Pose(PLACE["Hips"] + [sway, 0, 0], turns)


def walk(time):
    return STAND.blended(walking(time / CYCLE), smooth(time / 1.2)).on_ground()


def standing(time, arms, lean=0.0):
    """Upright on flat feet, leaning about the ankles, breathing; `arms` of both sides."""
    breath = 0.6 * np.sin(2 * np.pi * 0.25 * time)
    body_turn = about_x(lean)
    hips = body.ANKLE * [0, 1, 1] + body_turn @ (PLACE["Hips"] - body.ANKLE * [0, 1, 1])
    turns = {"Hips": body_turn, "Chest": about_x(-breath), "Neck": about_x(breath)} | both({"Foot": body_turn.T}) | both(arms)
    return Pose(hips, turns)


def stand(time):
    down = smooth(time)
    return STAND.blended(standing(time, arm(out=20, elbow=8), lean=0.4 * np.sin(2 * np.pi * 0.2 * time)), down)


def turn(time):
    """To and fro about the vertical, 0.4 s each way, four ways; the arms fly out a little later."""
    half, ways, begin = 0.4, 4, 0.6
    if_turning = lambda t: np.clip(t - begin, 0, half * ways)
    yaw = 90 * (1 - np.cos(np.pi * if_turning(time) / half))
    flight = np.sin(np.pi * if_turning(time) / (half * ways)) ** 2 * (0.7 + 0.3 * np.sin(np.pi * (time - 0.06 - begin) / half) ** 2)
    lag = -22 * np.sin(np.pi * if_turning(time - 0.06) / half) * np.sin(np.pi * if_turning(time) / (half * ways))
    down = standing(0, arm(out=22 + 38 * flight, elbow=8))
    swung = {}
    for side, sign in (("Left", 1), ("Right", -1)):
        swung |= one_side(side, arm(out=22 + 38 * flight, forwards=-sign * lag * 0.8, elbow=8 + 10 * flight))
    pose = STAND.blended(Pose(down.hips, down.turns | swung), smooth(time / begin))
    return Pose(pose.hips, pose.turns | {"Hips": about_y(yaw)})


def crouched(depth, least):
    """0 upright, 1 with the hips as near to the ankles as `least` [m]."""
    pelvis, chest = about_x(22 * depth), about_x(48 * depth)
    hip_at_rest = body.HIP - PLACE["Hips"]
    upright = np.linalg.norm(body.HIP - body.ANKLE)
    reach = upright + (least - upright) * depth
    aside, _, ahead = (body.HIP - body.ANKLE) * [1, 0, 1 - depth] - [0, 0, 0.13 * depth]
    above = np.sqrt(reach**2 - aside**2 - ahead**2)
    hips = (body.ANKLE + [0, above, ahead] - pelvis @ hip_at_rest) * [0, 1, 1]
    turns = trunk(pelvis, chest, about_x(12 * depth))
    turns |= both(leg_to(pelvis, hips, body.ANKLE, knees_out=12 * depth))
    return Pose(hips, turns | both(arm(out=45 - 23 * depth, forwards=72 * depth, inwards=10 * depth, elbow=12 * depth)))


def fleshy(pose, joint, first, last):
    """The hull of some of a part's spheres."""
    centres, radii = next((c, r) for name, c, r in pose.parts() if name == joint)
    return centres[first:last], radii[first:last]


def bisected(function, low, high):
    """Where a function that rises with its argument is 0."""
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return high


def thighs_on_calves():
    """How near [m] the hips come to the ankles as the back of the thigh rests on the calf."""
    def opening(reach):
        pose = crouched(1, reach)
        return body.gap(fleshy(pose, "LeftUpLeg", 1, 4), fleshy(pose, "LeftLeg", 1, 4))
    return bisected(opening, 0.2, 0.7)


LEAST_REACH = thighs_on_calves()


def crouch(time):
    return crouched(pulse(time, 1.5, 0.5, 1.5), LEAST_REACH)


def arms_on_chest():
    """How far out the upper arms hang as they just touch the trunk."""
    def opening(out):
        pose = Pose(turns=both(arm(out=out)))
        trunk_parts = [part for part in pose.parts() if part[0] in ("Chest", "Spine")]
        return min(body.gap(fleshy(pose, "LeftArm", 2, 4), part[1:]) for part in trunk_parts)
    return bisected(opening, -10, 30)


PRESSED = arms_on_chest()


def arms_pressed(time):
    pressed = standing(0, arm(out=PRESSED, inwards=20, elbow=10))
    return STAND.blended(pressed, pulse(time, 1.2, 1.0, 1.0))


ALL = {"walk": (walk, 6.0), "stand": (stand, 5.0), "turn": (turn, 3.6), "crouch": (crouch, 4.2), "arms_pressed": (arms_pressed, 3.6)}
