# SPDX-License-Identifier: Zlib
"""A flat piece of cloth between named edges, cut into even triangles. Used by make_garments.py. Metres."""
import numpy as np
from scipy.spatial import Delaunay


def evenly(path, spacing):
    """Points along a path, about `spacing` apart, with both its ends."""
    path = np.asarray(path, float)
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    count = max(1, round(along[-1] / spacing))
    at = np.linspace(0, along[-1], count + 1)
    points = np.stack([np.interp(at, along, path[:, k]) for k in range(2)], axis=1)
    return np.round(points, 5)


def is_inside(points, outline):
    """By how often a ray to the right crosses the outline."""
    inside = np.zeros(len(points), bool)
    for (ax, ay), (bx, by) in zip(outline, np.roll(outline, -1, axis=0)):
        if ay == by:
            continue
        crosses = (ay > points[:, 1]) != (by > points[:, 1])
        inside ^= crosses & (points[:, 0] < ax + (points[:, 1] - ay) * (bx - ax) / (by - ay))
    return inside


def distance_to(points, outline):
    nearest = np.full(len(points), np.inf)
    for a, b in zip(outline, np.roll(outline, -1, axis=0)):
        share = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(points - a - share[:, None] * (b - a), axis=1))
    return nearest


def lattice(outline, spacing):
    """Points of equal triangles, mirrored in x = 0."""
    (left, bottom), (right, top) = outline.min(axis=0), outline.max(axis=0)
    half = int(max(-left, right) / spacing) + 2
    rows = []
    for j, y in enumerate(np.arange(bottom, top, spacing * np.sqrt(0.75))):
        x = np.arange(-half, half + 1) * spacing if j % 2 == 0 else (np.arange(-half, half) + 0.5) * spacing
        rows.append(np.stack([x, np.full(len(x), y)], axis=1))
    return np.concatenate(rows)


def angles_of(points, triangles):
    """Degrees."""
    corners = points[triangles]
    angles = []
    for k in range(3):
        u, v = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        angles.append(np.degrees(np.arctan2(np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]), np.sum(u * v, axis=1))))
    return np.stack(angles, axis=1)


class Panel:
    """Points, triangles (all wound left about +z) and lines: numbers of points along each named edge."""

    ROUNDS = 12  # of evening out

    def __init__(self, name, edges, spacing, marks=None):
        """
        edges: (name, points) round the outline; each begins or ends where the one before it does.
        marks: by name, points within that are to be corners, too.
        """
        self.name, self.lines = name, {}
        self.points = self._outline(edges)
        outline = self.points
        for mark, places in (marks or {}).items():
            self.lines[mark] = list(range(len(self.points), len(self.points) + len(places)))
            self.points = np.concatenate([self.points, places])
        self._fill(outline, spacing)
        self._require_sound(len(outline))

    def _fill(self, outline, spacing):
        """With a lattice, as far from the outline as makes the least angle largest."""
        fixed = self.points
        inner = lattice(outline, spacing)
        inner = inner[is_inside(inner, outline)]
        away = np.minimum(distance_to(inner, outline), np.linalg.norm(inner[:, None] - fixed[None], axis=2).min(axis=1))
        best = None
        for least in (0.6, 0.65, 0.7, 0.75):
            self.points = np.concatenate([fixed, inner[away >= least * spacing]])
            for _ in range(self.ROUNDS):
                self._triangulate(outline)
                self._even_out(len(fixed))
            self.points = np.round(self.points, 5)
            self._triangulate(outline)
            if best is None or self.least_angle() > best[0]:
                best = self.least_angle(), self.points, self.triangles
        _, self.points, self.triangles = best

    def _outline(self, edges):
        loop, at = [], {}
        for k, (name, points) in enumerate(edges):
            meets_next = lambda end: np.array_equal(end, edges[(k + 1) % len(edges)][1][0]) or np.array_equal(
                end, edges[(k + 1) % len(edges)][1][-1])
            forwards = np.array_equal(points[0], loop[-1]) if loop else meets_next(points[-1])
            loop_points = points if forwards else points[::-1]
            numbers = list(range(max(len(loop) - 1, 0), max(len(loop) - 1, 0) + len(points)))
            at[name] = numbers if forwards else numbers[::-1]
            loop.extend(loop_points[1:] if loop else loop_points)
        assert np.array_equal(loop[0], loop[-1]), self.name
        last = len(loop) - 1
        self.lines |= {name: [0 if n == last else n for n in numbers] for name, numbers in at.items()}
        return np.array(loop[:-1])

    def _triangulate(self, outline):
        triangles = Delaunay(self.points).simplices
        triangles = triangles[is_inside(self.points[triangles].mean(axis=1), outline)]
        # Three points of one straight edge, which rounding has bent inwards: what is between them is outside.
        triangles = triangles[angles_of(self.points, triangles).min(axis=1) > 1]
        a, b, c = (self.points[triangles[:, k]] for k in range(3))
        turned = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) < (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        triangles[turned] = triangles[turned][:, ::-1]
        self.triangles = np.array(sorted(tuple(np.roll(t, -np.argmin(t))) for t in triangles))

    def _even_out(self, fixed):
        """Each free point goes to the middle of its neighbours."""
        pairs = np.concatenate([self.triangles[:, [i, j]] for i in range(3) for j in range(3) if i != j])
        pairs = np.unique(pairs, axis=0)
        sums, counts = np.zeros_like(self.points), np.zeros(len(self.points))
        np.add.at(sums, pairs[:, 0], self.points[pairs[:, 1]])
        np.add.at(counts, pairs[:, 0], 1)
        self.points[fixed:] = (sums / counts[:, None])[fixed:]

    def _require_sound(self, around):
        assert set(self.triangles.ravel()) == set(range(len(self.points))), f"{self.name}: lone points"
        assert self.least_angle() > 25, f"{self.name}: an angle of {self.least_angle():.1f} degrees"
        edges = {frozenset((t[k], t[k - 1])) for t in self.triangles for k in range(3)}
        assert all(frozenset((i, (i + 1) % around)) in edges for i in range(around)), f"{self.name}: its outline is cut"

    def least_angle(self):
        return angles_of(self.points, self.triangles).min()

    def mirrored(self, name):
        """What is left becomes right; lines keep their names but for that, and their order."""
        twin = object.__new__(Panel)
        twin.name = name
        twin.points = self.points * [-1, 1] + 0.0
        twin.triangles = self.triangles[:, ::-1]
        swap = lambda line: line.replace("left", "|").replace("right", "left").replace("|", "right")
        twin.lines = {swap(line): numbers for line, numbers in self.lines.items()}
        return twin

    def as_obj(self):
        lines = ["# SPDX-License-Identifier: Zlib", "# Written by make_garments.py. Metres, flat in z = 0."]
        lines += [f"v {x:.5f} {y:.5f} 0" for x, y in self.points + 0.0]
        lines += [f"g {self.name}"] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in self.triangles]
        for name, numbers in self.lines.items():
            lines += [f"g {name}", "l " + " ".join(str(n + 1) for n in numbers)]
        return "\n".join(lines) + "\n"
