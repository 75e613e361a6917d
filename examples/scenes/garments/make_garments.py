# SPDX-License-Identifier: Zlib
"""Writes the panels and patterns of a T-shirt and a bathrobe beside this script: python3 make_garments.py (numpy and scipy).

They lie flat about the figure of ../figures as it stands. With --check it prints their sizes and holds them against the body:
seams closed, nothing may be in it.
"""
import json
import pathlib
import sys

import numpy as np

from panel import Panel, evenly

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "figures"))
import body  # noqa: E402

OUT = np.array([np.sqrt(0.5), np.sqrt(0.5)])  # away from the left arm, upwards


def by_arm(along, out):
    """A place along the left arm from the shoulder, and across it."""
    return body.SHOULDER[:2] + along * body.ARM[:2] + out * OUT


def dip(end, depth):
    """Half an ellipse from a point on the left to its mirror image, hanging down `depth`."""
    angle = np.linspace(0, np.pi, 200)
    return np.stack([end[0] * np.cos(angle), end[1] - depth * np.sin(angle)], axis=1)


def bent(begin, towards, end):
    """A parabola that leaves `begin` and comes to `end` in the directions of a point between."""
    share = np.linspace(0, 1, 200)[:, None]
    return (1 - share) ** 2 * np.asarray(begin) + 2 * share * (1 - share) * np.asarray(towards) + share**2 * np.asarray(end)


def mirrored(edges):
    """Those of the right side."""
    return {name.replace("left", "right"): points * [-1, 1] for name, points in edges.items()}


class Garment:
    """Panels, how far ahead of the middle of the body each lies, and which edges are sewn."""

    def __init__(self, name, description, panels, seams):
        self.name, self.description, self.panels, self.seams = name, description, panels, seams

    def write(self):
        for panel, _ in self.panels:
            (HERE / f"{self.name}_{panel.name}.obj").write_text(panel.as_obj())
        panels = [{"name": panel.name, "obj": {"file": f"{self.name}_{panel.name}.obj", "translation_m": [0, 0, z]}} for panel, z in self.panels]
        seams = [{"first": {"panel": a, "line": line}, "second": {"panel": b, "line": line}} for a, b, line in self.seams]
        listed = lambda items: ",\n".join("    " + json.dumps(item) for item in items)
        (HERE / f"{self.name}.json").write_text(f'{{\n  "description": "{self.description}",\n  "panels": [\n{listed(panels)}\n  ],\n'
                                                f'  "seams": [\n{listed(seams)}\n  ]\n}}\n')


def sleeve_seams(fronts):
    """Front to back along the sleeve, both to the body; `fronts`: by side, the panel there."""
    seams = []
    for side in ("left", "right"):
        front, back = f"sleeve_front_{side}", f"sleeve_back_{side}"
        seams += [(fronts[side], front, f"armhole_{side}"), ("back", back, f"armhole_{side}"),
                  (front, back, f"sleeve_top_{side}"), (front, back, f"sleeve_bottom_{side}")]
    return seams


def sleeves(edges, spacing, front_z, back_z):
    cut = [(name, edges[name]) for name in ("sleeve_top_left", "cuff_left", "sleeve_bottom_left", "armhole_left")]
    panels = []
    for face, z in (("front", front_z), ("back", back_z)):
        left = Panel(f"sleeve_{face}_left", cut, spacing)
        panels += [(left, z), (left.mirrored(f"sleeve_{face}_right"), z)]
    return panels


def side_edges(corners, spacing):
    """Edges of the left side between named corners, each from the neck outwards or downwards."""
    ways = {"shoulder_left": "neck shoulder", "side_left": "underarm hem", "sleeve_top_left": "shoulder cuff_top",
            "cuff_left": "cuff_top cuff_bottom", "sleeve_bottom_left": "underarm cuff_bottom"}
    edges = {name: evenly([corners[corner] for corner in way.split()], spacing) for name, way in ways.items()}
    return edges | {"armhole_left": evenly(bent(corners["shoulder"], corners["armpit"], corners["underarm"]), spacing)}


def tshirt(spacing=0.0134, front_z=0.137, back_z=-0.158):
    corners = {"neck": (0.085, 1.524), "shoulder": (0.205, 1.478), "armpit": (0.200, 1.32), "underarm": (0.275, 1.216), "hem": (0.278, 0.86),
               "cuff_top": by_arm(0.235, 0.085), "cuff_bottom": by_arm(0.265, -0.085)}
    edges = side_edges(corners, spacing)
    edges |= mirrored(edges)
    edges["hem"] = evenly([corners["hem"], np.array(corners["hem"]) * [-1, 1]], spacing)
    round_ = ("shoulder_left", "armhole_left", "side_left", "hem", "side_right", "armhole_right", "shoulder_right", "neck")
    panels = []
    for name, depth, z in (("front", 0.090, front_z), ("back", 0.022, back_z)):
        edges["neck"] = evenly(dip(corners["neck"], depth), spacing)
        panels.append((Panel(name, [(edge, edges[edge]) for edge in round_], spacing), z))
    panels += sleeves(edges, spacing, front_z, back_z)
    seams = [("front", "back", f"{edge}_{side}") for edge in ("shoulder", "side") for side in ("left", "right")]
    return Garment("tshirt", "A T-shirt for the figure of ../figures: chest 1.10 m, sleeves to the upper arm, hem at the hip.", panels,
                   seams + sleeve_seams({"left": "front", "right": "front"}))


def bathrobe(spacing=0.0212, front_z=0.137, back_z=-0.160, between_fronts=0.020):
    overlap, fastened = 0.06, {"belt": 1.06, "breast": 1.28}
    corners = {"neck": (0.080, 1.542), "shoulder": (0.215, 1.492), "armpit": (0.205, 1.28), "underarm": (0.31, 1.160), "hem": (0.375, 0.36),
               "cuff_top": by_arm(0.55, 0.092), "cuff_bottom": by_arm(0.55, -0.118)}
    edges = side_edges(corners, spacing)
    lapel_end, corner = (-overlap, 1.32), (-overlap, corners["hem"][1])
    edges |= {"lapel_left": evenly([corners["neck"], lapel_end], spacing), "edge_left": evenly([lapel_end, corner], spacing),
              "hem_left": evenly([corners["hem"], corner], spacing)}
    round_ = ("shoulder_left", "armhole_left", "side_left", "hem_left", "edge_left", "lapel_left")
    marks = {name: np.array([[x, height] for x in (-0.04, 0, 0.04)]) for name, height in fastened.items()}
    left = Panel("front_left", [(edge, edges[edge]) for edge in round_], spacing, marks)
    right = left.mirrored("front_right")
    for name in fastened:
        right.lines[name] = right.lines[name][::-1]  # the same places in the same order
    edges |= mirrored(edges)
    edges["neck"] = evenly(dip(corners["neck"], 0.025), spacing)
    edges["hem"] = evenly([corners["hem"], np.array(corners["hem"]) * [-1, 1]], spacing)
    round_ = ("shoulder_left", "armhole_left", "side_left", "hem", "side_right", "armhole_right", "shoulder_right", "neck")
    back = Panel("back", [(edge, edges[edge]) for edge in round_], spacing)
    panels = [(back, back_z), (left, round(front_z + between_fronts, 4)), (right, front_z)] + sleeves(edges, spacing, front_z, back_z)
    seams = [(f"front_{side}", "back", f"{edge}_{side}") for edge in ("shoulder", "side") for side in ("left", "right")]
    seams += sleeve_seams({"left": "front_left", "right": "front_right"}) + [("front_left", "front_right", name) for name in fastened]
    return Garment("bathrobe", "A bathrobe for the figure of ../figures: to the middle of the calf, the left front over the right, "
                   "held together at the belt and at the breast.", panels, seams)


class Sewn:
    """Where each panel's points are with the seams closed: at the middle of those that become one."""

    def __init__(self, garment):
        self.garment = garment
        panels = {panel.name: panel for panel, _ in garment.panels}
        first, count = {}, 0
        for name, panel in panels.items():
            first[name] = count
            count += len(panel.points)
        self.first = first
        self.places = np.concatenate([np.column_stack([panel.points, np.full(len(panel.points), z)]) for panel, z in garment.panels])
        self.root = np.arange(count)
        self.is_sewn = np.zeros(count, bool)
        for a, b, line in garment.seams:
            assert len(panels[a].lines[line]) == len(panels[b].lines[line]), line
            for i, j in zip(panels[a].lines[line], panels[b].lines[line]):
                self._join(first[a] + i, first[b] + j)
        self.farthest = self._draw_together()
        self.nodes = len(np.unique(self.root))
        self.triangles = np.concatenate([panel.triangles + first[panel.name] for panel, _ in garment.panels])

    def _join(self, i, j):
        self.is_sewn[[i, j]] = True
        self.root[self.root == self.root[j]] = self.root[i]

    def _draw_together(self):
        """How far apart [m] in x and y the points of one seam were; they lie over each other if this is 0."""
        farthest = 0.0
        for root in np.unique(self.root[self.is_sewn]):
            joined = self.root == root
            farthest = max(farthest, np.ptp(self.places[joined, :2], axis=0).max())
            self.places[joined] = self.places[joined].mean(axis=0)
        return farthest


def depth_in_body(points):
    """Least signed distance [m] of each point to the parts' surfaces; negative within. The hulls are a little too large here."""
    out = body.directions(1500)
    least = np.full(len(points), np.inf)
    for _, centres, radii in body.parts():
        reach = np.max(centres @ out.T + radii[:, None], axis=0)
        for begin in range(0, len(points), 20000):
            some = slice(begin, begin + 20000)
            least[some] = np.minimum(least[some], np.max(points[some] @ out.T - reach, axis=1))
    return least


def check(garment):
    sewn = Sewn(garment)
    vertices = sum(len(panel.points) for panel, _ in garment.panels)
    print(f"{garment.name}: {vertices} vertices of panels, {sewn.nodes} nodes sewn, {len(sewn.triangles)} triangles, {len(garment.seams)} seams, "
          f"at most {sewn.farthest:.5f} m apart in x and y")
    for panel, z in garment.panels:
        print(f"  {panel.name}: {len(panel.points)} vertices, {len(panel.triangles)} triangles, least angle {panel.least_angle():.1f} degrees, z {z}")
    near_seam = sewn.triangles[np.any(sewn.is_sewn[sewn.triangles], axis=1)]
    pairs = np.unique(np.sort(np.concatenate([near_seam[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1), axis=0)
    share = np.linspace(0, 1, 20)[:, None, None]
    samples = (sewn.places[pairs[:, 0]] * (1 - share) + sewn.places[pairs[:, 1]] * share).reshape(-1, 3)
    at_points, at_edges = depth_in_body(sewn.places), depth_in_body(samples)
    print(f"  vertices in the body: {np.sum(at_points < 0)} (nearest {at_points.min():.4f} m); of {len(pairs)} edges by seams, 20 points each, "
          f"in the body: {np.sum(at_edges.reshape(20, -1).min(axis=0) < 0)} (nearest {at_edges.min():.4f} m)")
    return np.sum(at_points < 0) + np.sum(at_edges < 0)


def main():
    garments = [tshirt(), bathrobe()]
    for garment in garments:
        garment.write()
    if "--check" in sys.argv[1:]:
        sys.exit(1 if sum(check(garment) for garment in garments) else 0)


if __name__ == "__main__":
    main()
