# SPDX-License-Identifier: Zlib
"""Table II of Basori et al. (2017) and the two falls of its Fig. 19, beside their closed forms.

    python3 two_falls.py [PICTURE.png]

The cloth takes up water evenly for ten seconds, until it is 84 times as heavy as it was. Then it falls from 19.62 m, dry
and saturated, in air whose drag is linear in speed: the time constant of the dry cloth, 0.585 s, is what the paper's two
times ask for. With a picture's name it needs matplotlib.
"""

import sys

import numpy as np

import wetcloth

GRAVITY = 9.81  # [m/s^2]
HEIGHT = 19.62  # [m]
TIME_CONSTANT = 0.585  # mass / drag of the dry cloth [s]
DRY_MASS_G = 0.01  # of the paper's cloth [g]
AREAL_DENSITY = 0.010  # of the fabric "table_ii" [kg/m^2]


def cloth(effects, **more):
    """A scene with one level cloth of 1 m^2 and nothing else."""
    patch = {"columns": 9, "rows": 9, "origin_m": [-0.5, 0, 0.5], "edge_u_m": [1, 0, 0], "edge_v_m": [0, 0, -1]}
    only = {"patch": patch, "fabric": "table_ii", "collisions": [], "effects": effects, **more}
    return {"world": "soft_rigid", "step_s": 1 / 60, "substeps": 4, "gravity_m_s2": [0, -GRAVITY, 0], "cloths": [only]}


def table_ii():
    """Masses at the end of each of ten seconds [g]."""
    scene = wetcloth.open(cloth({"absorption": {"mode": "paper", "law": "ramp", "ramp_duration_s": 10}}))
    sheet = scene.cloths[0]
    dry = sheet.dry_mass.sum()
    masses = [DRY_MASS_G]
    for _ in range(10):
        scene.step(60)
        masses.append(DRY_MASS_G * (dry + sheet.water.sum()) / dry)
    return np.array(masses)


def fall(saturation):
    """Times [s] and heights [m] until it has fallen HEIGHT."""
    drag = {"law": "linear", "linear_drag_n_s_m3": AREAL_DENSITY / TIME_CONSTANT, "velocity_m_s": [0, 0, 0]}
    scene = wetcloth.open(cloth({"wind": drag}, initial_saturation=saturation))
    sheet = scene.cloths[0]
    times, heights = [0.0], [HEIGHT]
    while heights[-1] > 0:
        scene.step()
        times.append(scene.time_s)
        heights.append(HEIGHT + sheet.positions[:, 1].mean())
    return np.array(times), np.array(heights)


def time_to_fall(times, heights):
    """When the ground is reached, between two steps [s]."""
    return np.interp(0, heights[::-1], times[::-1])


def closed_form(ratio, times):
    """Height of a body of `ratio` times the dry mass that falls with linear drag [m]."""
    tau = ratio * TIME_CONSTANT
    return HEIGHT - GRAVITY * tau * (times - tau * (1 - np.exp(-times / tau)))


def draw(picture, masses, falls):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    left.plot(range(11), DRY_MASS_G + 0.083 * np.arange(11), color="0.7", label="Table II")
    left.plot(range(11), masses, "o", label="wetcloth")
    left.set(xlabel="time [s]", ylabel="mass [g]", title="Table II")
    for name, ratio, (times, heights) in falls:
        line, = right.plot(times, closed_form(ratio, times), alpha=0.4, linewidth=4, label=f"{name}, closed form")
        right.plot(times, heights, color=line.get_color(), label=f"{name}, wetcloth")
    right.set(xlabel="time [s]", ylabel="height [m]", ylim=(0, None), title="Two falls from 19.62 m")
    for axes in (left, right):
        axes.legend()
        axes.grid(alpha=0.3)
    figure.savefig(picture, dpi=100)


def main():
    masses = table_ii()
    print("Table II [g]  ", " ".join(f"{mass:.3f}" for mass in masses))
    falls = [("dry", 1, fall(0)), ("saturated", 84, fall(1))]
    for name, ratio, (times, heights) in falls:
        late = np.linspace(0, 10, 100001)
        expected = np.interp(0, closed_form(ratio, late)[::-1], late[::-1])
        print(f"{name:10} fall: {time_to_fall(times, heights):.3f} s, closed form {expected:.3f} s")
    if len(sys.argv) > 1:
        draw(sys.argv[1], masses, falls)


if __name__ == "__main__":
    main()
