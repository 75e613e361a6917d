# SPDX-License-Identifier: Zlib
"""Writes person.json and the motion files beside this script: python3 make_figure.py (numpy and scipy).

With --check it prints the figure's girths and how near its feet keep to the ground.
"""
import json
import pathlib
import sys

import numpy as np
from scipy.spatial import ConvexHull

import body
import motions
from poses import PLACE, Pose
from rotations import angles_zxy

HERE = pathlib.Path(__file__).parent
RATE = 30  # frames a second


def written_parts():
    written = []
    for joint, centres, radii in body.parts():
        spheres = [{"centre_m": [round(float(x), 4) + 0.0 for x in c - PLACE[joint]], "radius_m": round(float(r), 4)}
                   for c, r in zip(centres, radii)]
        written.append("    " + json.dumps({"joint": joint, "spheres": spheres}))
    return '{\n  "description": "A man of 1.75 m, as walk.bvh and the other motions beside this file move him.",\n  "parts": [\n' + \
        ",\n".join(written) + "\n  ]\n}\n"


def number(value):
    return f"{value + 0.0:.5f}".replace("-0.00000", "0.00000")


def hierarchy():
    """The joints depth first, as the file has them, and its text."""
    order, lines = [], ["HIERARCHY"]

    def add(name, parent, depth):
        pad = "  " * depth
        offset = PLACE[name] - (PLACE[parent] if parent else PLACE[name])
        order.append(name)
        channels = "3 Zrotation Xrotation Yrotation" if parent else "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
        lines.extend([f"{pad}{'JOINT' if parent else 'ROOT'} {name}", pad + "{", f"{pad}  OFFSET {' '.join(map(number, offset))}",
                      f"{pad}  CHANNELS {channels}"])
        children = [(n, p) for n, p, _ in body.joints() if p == name]
        for child, _ in children:
            add(child, name, depth + 1)
        if not children:
            side = "Right" if name.startswith("Right") else "Left"
            end = np.array(body.ENDS[name.removeprefix(side)], float)
            end = (body.mirrored(end) if side == "Right" else end) - PLACE[name]
            lines.extend([pad + "  End Site", pad + "  {", f"{pad}    OFFSET {' '.join(map(number, end))}", pad + "  }"])
        lines.append(pad + "}")

    add("Hips", None, 0)
    return order, lines


def poses_of(motion, duration):
    return [motion(frame / RATE) for frame in range(round(duration * RATE) + 1)]


def written_motion(poses):
    order, lines = hierarchy()
    turns = np.array([[angles_zxy(pose.turns[name]) for name in order] for pose in poses])
    turns = np.unwrap(turns, axis=0, period=360)
    lines += ["MOTION", f"Frames: {len(poses)}", f"Frame Time: {1 / RATE:.7f}"]
    for pose, angles in zip(poses, turns):
        lines.append(" ".join(map(number, [*pose.hips, *angles.ravel()])))
    return "\n".join(lines) + "\n"


def girth(pose, joints, height, end=None):
    """Of a level section through parts of these joints."""
    points = []
    around = body.directions(6000)
    for joint, centres, radii in pose.parts():
        if joint not in joints:
            continue
        far = np.argmax(centres @ around.T + radii[:, None], axis=0)
        hull = ConvexHull(centres[far] + around * radii[far][:, None])
        for a, b in {tuple(sorted((t[i], t[i - 1]))) for t in hull.simplices for i in range(3)}:
            p, q = hull.points[a], hull.points[b]
            if (p[1] - height) * (q[1] - height) < 0:
                points.append((p + (q - p) * (height - p[1]) / (q[1] - p[1]))[[0, 2]])
    return ConvexHull(np.array(points)).area  # of two dimensions: its length


def check():
    still = Pose()
    trunk = ("Hips", "Spine", "Chest")
    for name, height in (("chest", 1.30), ("waist", 1.07), ("hip", 0.90)):
        print(f"{name} girth {girth(still, trunk, height):.3f} m")
    shoulders = [c[0] + r for joint, centres, radii in still.parts() if joint == "LeftArm" for c, r in zip(centres[:1], radii)]
    print(f"shoulder width {2 * shoulders[0]:.3f} m, upper arm girth {2 * np.pi * body.SIDE_PARTS[0][1][2][1]:.3f} m")
    print(f"parts {len(body.parts())}; arms pressed {motions.PRESSED:.1f} degrees out; hips to ankles crouched {motions.LEAST_REACH:.3f} m")
    for name, (motion, duration) in motions.ALL.items():
        poses = poses_of(motion, duration)
        lowest = [pose.lowest() for pose in poses]
        step = max(abs(np.diff([p.hips[1] for p in poses], 2))) * RATE**2
        print(f"{name}: {len(poses)} frames, lowest of the feet {min(lowest):+.4f} to {max(lowest):+.4f} m, hips' largest acceleration {step:.1f} m/s^2")
        assert all(np.allclose(turn, np.eye(3)) for turn in poses[0].turns.values()), name


def main():
    (HERE / "person.json").write_text(written_parts())
    for name, (motion, duration) in motions.ALL.items():
        (HERE / f"{name}.bvh").write_text(written_motion(poses_of(motion, duration)))
    if "--check" in sys.argv[1:]:
        check()


if __name__ == "__main__":
    main()
