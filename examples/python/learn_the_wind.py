# SPDX-License-Identifier: Zlib
"""Learns the wind from how a flag moves.

    python3 learn_the_wind.py

A flag hangs in a wind that nobody tells us. From the places of its nodes in the first half second the wind is found by
Gauss-Newton: how the places change with each component of the wind is told by runs beside each other in threads, which
step at the same time, as stepping lets other threads run.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

import wetcloth

STEPS = 30  # of 1/60 s that are looked at


def flag():
    patch = {"columns": 13, "rows": 9, "origin_m": [0, 1, 0], "edge_u_m": [1.2, 0, 0], "edge_v_m": [0, 0.8, 0]}
    still_air = {"wind": {"velocity_m_s": [0, 0, 0]}}
    cloth = {"patch": patch, "fabric": "cotton", "pins": {"edges": ["left"]}, "effects": still_air}
    return {"world": "soft_rigid", "step_s": 1 / 60, "solver": "wetcloth", "cloths": [cloth]}


def motion(scene, start, wind):
    """Places of all nodes in each step, in this wind [m]."""
    scene.restore(start)
    sheet = scene.cloths[0]
    sheet.change("wind", velocity_m_s=wind)
    seen = []
    for _ in range(STEPS):
        scene.step()
        seen.append(sheet.positions.copy())
    return np.array(seen, dtype=float)


def learn(seen, rounds=8, nudge=0.05):
    """The wind in which a flag moves as it was seen [m/s]."""
    scenes = [wetcloth.open(flag()) for _ in range(4)]
    start = scenes[0].save()
    wind = np.array([2.0, 0.0, 0.5])  # a guess; along the flag alone it would not move at all
    with ThreadPoolExecutor() as threads:
        for number in range(rounds):
            tries = [wind, *(wind + nudge * np.eye(3))]
            moved = list(threads.map(motion, scenes, [start] * 4, tries))
            residual = (seen - moved[0]).ravel()
            print(f"round {number}: wind {np.round(wind, 4)} m/s, places off by {np.sqrt(np.mean(residual**2)):.1e} m")
            slopes = np.array([(each - moved[0]).ravel() / nudge for each in moved[1:]]).T
            change = np.linalg.lstsq(slopes, residual, rcond=None)[0]
            wind = wind + change
            if np.linalg.norm(change) < 1e-4:
                break
    return wind


def main():
    secret = np.array([3.0, 0.3, 1.2])
    scene = wetcloth.open(flag())
    seen = motion(scene, scene.save(), secret)
    wind = learn(seen)
    print(f"learned {np.round(wind, 3)} m/s, it was {secret}")


if __name__ == "__main__":
    main()
