# SPDX-License-Identifier: Zlib
"""The skeleton and the surface of a man of 1.75 m, standing with his arms 45 degrees out. Used by make_figure.py.

Metres; y up, he faces +z, x to his left, the ground is y = 0. Every joint's axes are parallel to these as he stands so.
"""
import numpy as np

ARM = np.array([np.sqrt(0.5), -np.sqrt(0.5), 0])  # along the left arm
SHOULDER = np.array([0.176, 1.42, -0.005])
UPPER_ARM, FOREARM = 0.30, 0.255
HIP, KNEE, ANKLE = np.array([0.09, 0.905, 0]), np.array([0.115, 0.49, 0.004]), np.array([0.14, 0.075, -0.012])

CENTRE = [  # joint, its parent, its place
    ("Hips", None, (0, 0.95, 0)),
    ("Spine", "Hips", (0, 1.04, -0.01)),
    ("Chest", "Spine", (0, 1.18, -0.015)),
    ("Neck", "Chest", (0, 1.475, -0.015)),
    ("Head", "Neck", (0, 1.56, 0)),
]
SIDE = [
    ("Arm", "Chest", SHOULDER),
    ("ForeArm", "Arm", SHOULDER + UPPER_ARM * ARM),
    ("Hand", "ForeArm", SHOULDER + (UPPER_ARM + FOREARM) * ARM),
    ("UpLeg", "Hips", HIP),
    ("Leg", "UpLeg", KNEE),
    ("Foot", "Leg", ANKLE),
]
ENDS = {"Head": (0, 1.75, 0), "Hand": SHOULDER + (UPPER_ARM + FOREARM + 0.18) * ARM, "Foot": ANKLE + np.array([0, -0.055, 0.19])}


def mirrored(place):
    return np.array([-place[0], place[1], place[2]])


def pair(x, y, z, radius):
    """A sphere on each side."""
    return [((x, y, z), radius), ((-x, y, z), radius)]


def on_arm(along, out, ahead, radius):
    """A sphere on the left arm: along it from the shoulder, away from the body, and ahead."""
    return (SHOULDER + along * ARM + out * np.array([np.sqrt(0.5), np.sqrt(0.5), 0]) + np.array([0, 0, ahead]), radius)


def on_leg(start, end, share, ahead, radius, out=0.0):
    return (start + share * (end - start) + np.array([out, 0, ahead]), radius)


CENTRE_PARTS = [
    ("Hips", pair(0.075, 0.905, 0.015, 0.093) + pair(0.078, 0.90, -0.028, 0.093) + pair(0.060, 0.995, 0.005, 0.088)),
    ("Spine", pair(0.055, 1.00, 0.012, 0.087) + pair(0.055, 1.00, -0.022, 0.087) + pair(0.052, 1.12, 0.010, 0.087)
     + pair(0.052, 1.12, -0.025, 0.087)),
    ("Chest", pair(0.072, 1.29, 0.035, 0.080) + pair(0.072, 1.30, -0.055, 0.080) + pair(0.058, 1.15, 0.020, 0.082)
     + pair(0.056, 1.15, -0.033, 0.082)),
    ("Chest", pair(0.150, 1.425, -0.008, 0.047) + pair(0.072, 1.300, 0.036, 0.078) + pair(0.074, 1.325, -0.056, 0.078)
     + [((0, 1.468, -0.022), 0.056)]),
    ("Neck", [((0, 1.455, -0.018), 0.060), ((0, 1.50, -0.010), 0.058), ((0, 1.575, 0.006), 0.055)]),
    ("Head", [((0, 1.670, -0.022), 0.080), ((0, 1.668, 0.020), 0.076), ((0, 1.620, 0.036), 0.058), ((0, 1.565, 0.050), 0.038)]
     + pair(0.028, 1.585, 0.018, 0.038)),
]
SIDE_PARTS = [
    ("Arm", [on_arm(0.0, 0, 0, 0.049), on_arm(0.07, 0.002, 0.002, 0.049), on_arm(0.15, 0, 0.004, 0.0475), on_arm(0.30, 0, 0, 0.040)]),
    ("ForeArm", [on_arm(0.30, 0, 0, 0.040), on_arm(0.365, 0.002, 0.003, 0.042), on_arm(0.555, 0, 0, 0.027)]),
    ("Hand", [on_arm(0.55, 0, 0, 0.026), on_arm(0.615, 0, 0.024, 0.019), on_arm(0.615, 0, -0.024, 0.019),
              on_arm(0.660, -0.004, 0.022, 0.015), on_arm(0.660, -0.004, -0.022, 0.015), on_arm(0.725, -0.012, 0.008, 0.010),
              on_arm(0.725, -0.012, -0.010, 0.010)]),
    ("UpLeg", [on_leg(HIP, KNEE, 0.0, 0, 0.082), on_leg(HIP, KNEE, 0.12, -0.012, 0.084), on_leg(HIP, KNEE, 0.40, 0.010, 0.074),
               on_leg(HIP, KNEE, 0.70, 0.005, 0.065), on_leg(HIP, KNEE, 1.0, 0.004, 0.053)]),
    ("Leg", [on_leg(KNEE, ANKLE, 0.0, 0.002, 0.052), on_leg(KNEE, ANKLE, 0.30, -0.018, 0.053), on_leg(KNEE, ANKLE, 0.55, -0.008, 0.046),
             on_leg(KNEE, ANKLE, 1.0, 0, 0.035)]),
    ("Foot", [(ANKLE, 0.037), (ANKLE + np.array([0, -0.043, -0.040]), 0.032), (ANKLE + np.array([0.022, -0.051, 0.105]), 0.024),
              (ANKLE + np.array([-0.016, -0.049, 0.115]), 0.026), (ANKLE + np.array([0.010, -0.058, 0.170]), 0.017)]),
]


def joints():
    """Names, parents and places, each parent before its children."""
    made = [(name, parent, np.array(place, float)) for name, parent, place in CENTRE]
    for side, put in (("Left", np.array), ("Right", mirrored)):
        for name, parent, place in SIDE:
            made.append((side + name, parent if parent in ("Chest", "Hips") else side + parent, put(place)))
    return made


def parts():
    """Joints and the spheres whose convex hulls follow them, as he stands: (joint, centres, radii)."""
    made = [(joint, spheres) for joint, spheres in CENTRE_PARTS]
    made += [("Left" + joint, spheres) for joint, spheres in SIDE_PARTS]
    made += [("Right" + joint, [(mirrored(c), r) for c, r in spheres]) for joint, spheres in SIDE_PARTS]
    return [(joint, np.array([c for c, _ in spheres], float), np.array([r for _, r in spheres])) for joint, spheres in made]


def directions(count):
    """Spread evenly over the sphere."""
    i = np.arange(count)
    height = 1 - (2 * i + 1) / count
    around = i * np.pi * (3 - np.sqrt(5))
    reach = np.sqrt(1 - height**2)
    return np.stack([reach * np.cos(around), height, reach * np.sin(around)], axis=1)


def gap(first, second, count=4000):
    """Distance [m] between two hulls of spheres (centres, radii); negative as deep as they overlap."""
    out = directions(count)
    reach_of = lambda centres, radii, way: np.max(centres @ way.T + radii[:, None], axis=0)
    return np.max(-reach_of(*first, out) - reach_of(*second, -out))
