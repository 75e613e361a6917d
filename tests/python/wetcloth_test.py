# SPDX-License-Identifier: Zlib
"""The Python package, in the precision that WETCLOTH_PRECISION names."""

import gc
import os
import tempfile
import threading
import time
import unittest

import numpy as np

import wetcloth

PRECISION = os.environ.get("WETCLOTH_PRECISION", "float32")
OTHER = {"float32": "float64", "float64": "float32"}[PRECISION]
ROUNDING = {"float32": 6e-8, "float64": 1.1e-16}[PRECISION]  # half of the last digit of Bullet's numbers
GRAVITY = 9.81
STEP = 1 / 64  # a power of two: of a substep, Bullet hands its soft bodies what float32 has of it, in float64, too


def scene(effects=None, pins=None, **more):
    """One cloth of 0.5 m x 0.5 m at y = 0, in a world with nothing else."""
    patch = {"columns": 6, "rows": 6, "origin_m": [0, 0, 0], "edge_u_m": [0.5, 0, 0], "edge_v_m": [0, 0, 0.5]}
    cloth = {"name": "sheet", "patch": patch, "fabric": "cotton", "collisions": [], "effects": effects or {}}
    if pins:
        cloth["pins"] = pins
    return {"world": "soft_rigid", "precision": PRECISION, "step_s": STEP, "substeps": 4,
            "gravity_m_s2": [0, -GRAVITY, 0], "cloths": [{**cloth, **more}]}


def opened(*args, **more):
    return wetcloth.open(scene(*args, **more))


def flipped(state, place):
    """The same bytes but one."""
    return state[:place] + bytes([state[place] ^ 1]) + state[place + 1:]


class Stepping(unittest.TestCase):
    def test_a_free_cloth_falls(self):
        falling = opened()
        self.assertEqual((falling.precision, falling.steps, falling.time_s), (PRECISION, 0, 0))
        falling.step(32)
        sheet = falling.cloths[0]
        self.assertAlmostEqual(falling.time_s, 0.5, delta=1e-12)
        # Bullet takes velocities from two places, rounded below 2 m, over each of 128 substeps: a random walk.
        error = np.sqrt(128) * 2 * 2 * ROUNDING * 256
        np.testing.assert_allclose(sheet.velocities, np.tile([0, -GRAVITY * 0.5, 0], (36, 1)), rtol=0, atol=error)

    def test_water_is_accounted_for(self):
        wet = opened({"absorption": {}, "drying": {}, "dripping": {}})
        wet.step(60)
        sheet = wet["sheet"]
        ledger = sheet.ledger
        self.assertGreater(ledger["absorbed"], 0)
        left = ledger["initial"] + ledger["absorbed"] - ledger["dripped"] - ledger["evaporated"]
        self.assertAlmostEqual(left, ledger["held"], delta=1e-12 * ledger["absorbed"])
        self.assertAlmostEqual(sheet.water.sum(), ledger["held"], delta=1e-12 * ledger["held"])
        np.testing.assert_allclose(sheet.saturation, sheet.water / sheet.capacity, rtol=1e-12)
        self.assertIsNone(wet.ledger)

    def test_the_worlds_water_is_accounted_for(self):
        dripping = wetcloth.open({**scene({"dripping": {}}, initial_saturation=1), "drops": {}})
        dripping.step(60)
        ledger = dripping.ledger
        came = sum(ledger[key] for key in ("initial", "absorbed", "brought"))
        went = sum(ledger[key] for key in ("held", "in_flight", "films", "evaporated", "left"))
        self.assertGreater(ledger["in_flight"], 0)
        self.assertAlmostEqual(came, went, delta=1e-12 * came)

    def test_what_blows_up_is_told(self):
        stiff = scene(pins={"edges": ["top"]}, spring_stiffness_n_m=1e5)  # explicit, far beyond what 1/240 s bears
        wild = wetcloth.open({**stiff, "world": "deformable"})
        with self.assertRaisesRegex(wetcloth.RunError, "/cloths/0"):
            wild.step(10)


class Arrays(unittest.TestCase):
    def test_they_are_views(self):
        falling = opened({"absorption": {}})
        sheet = falling.cloths[0]
        places, water = sheet.positions, sheet.water
        self.assertEqual(places.shape, (36, 3))
        self.assertEqual(places.dtype, PRECISION)
        before = places.copy()
        falling.step()
        self.assertTrue((places[:, 1] < before[:, 1]).all())
        self.assertTrue((water > 0).all())
        self.assertTrue(np.shares_memory(places, sheet.positions))
        self.assertTrue(np.shares_memory(water, sheet.water))
        for array in (places, water, sheet.velocities, sheet.normals, sheet.colours):
            self.assertFalse(array.flags.writeable)

    def test_they_outlive_the_names_of_the_scene(self):
        falling = opened()
        falling.step()
        places = falling.cloths[0].positions
        kept = places.copy()
        del falling
        gc.collect()
        np.testing.assert_array_equal(places, kept)

    def test_triangles_cover_the_cloth(self):
        sheet = opened().cloths[0]
        corners = sheet.positions[sheet.triangles].astype(float)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.assertAlmostEqual(np.linalg.norm(normals, axis=1).sum() / 2, 0.25, delta=1e-6)

    def test_wet_cloth_is_darker(self):
        dry = opened().cloths[0].colours
        wet = opened(initial_saturation=1).cloths[0].colours
        self.assertTrue((wet < dry).all())


class Changing(unittest.TestCase):
    def test_wind_blows_where_it_is_told_to(self):
        still = opened({"wind": {"velocity_m_s": [0, 0, 0]}})
        sheet = still.cloths[0]
        sheet.change("wind", velocity_m_s=np.array([0.0, 40.0, 0.0]))
        self.assertEqual(sheet.effects["wind"], {"velocity_m_s": [0, 40, 0]})
        still.step()
        self.assertGreater(sheet.velocities[:, 1].mean(), 0)  # it lifts the sheet, against its weight
        sheet.remove("wind")
        self.assertEqual(sheet.effects, {})
        speed = np.average(sheet.velocities[:, 1], weights=sheet.dry_mass)
        still.step()
        # Links keep the momentum. Bullet takes velocities from places, which are rounded, over a substep of 1/256 s.
        change = np.average(sheet.velocities[:, 1], weights=sheet.dry_mass) - speed
        self.assertAlmostEqual(change, -GRAVITY * STEP, delta=4 * ROUNDING * 256)

    def test_an_effect_that_is_changed_keeps_what_it_knows(self):
        floor = {"box": {"half_extents_m": [2, 0.1, 2], "centre_m": [0, -0.13, 0]}}
        wet_floor = {**scene({"contact_wetting": {"films": [{"collider": 0, "water_kg": 1}], "rate_kg_m2_s": 0.1}}),
                     "colliders": [floor]}
        del wet_floor["cloths"][0]["collisions"]
        wet_floor["cloths"][0]["effects"]["wet_friction"] = {}
        scenes = [wetcloth.open(wet_floor) for _ in range(2)]
        for lying in scenes:
            lying.step(30)
        sheet = scenes[0].cloths[0]
        sheet.change("wet_friction")
        for lying in scenes:
            lying.step(10)
        self.assertGreater(sheet.water.sum(), 0)
        np.testing.assert_array_equal(sheet.water, scenes[1].cloths[0].water)

    def test_pins_go_where_they_are_sent(self):
        hanging = opened(pins={"edges": ["top"]})
        sheet = hanging.cloths[0]
        start = sheet.positions[sheet.pins]
        goal = start + np.array([0, 0.3, 0])
        sheet.move_pins(goal)
        hanging.step(10)
        np.testing.assert_allclose(sheet.positions[sheet.pins], goal, rtol=0, atol=4 * ROUNDING)
        hanging.step(10)  # and stay there
        np.testing.assert_allclose(sheet.positions[sheet.pins], goal, rtol=0, atol=4 * ROUNDING)

    def test_water_is_set(self):
        sheet = opened().cloths[0]
        sheet.water = sheet.capacity / 2
        np.testing.assert_allclose(sheet.saturation, 0.5, rtol=1e-15)
        self.assertAlmostEqual(sheet.ledger["initial"], sheet.capacity.sum() / 2, delta=1e-15)
        bad = sheet.capacity / 3
        bad[7] = np.nan
        with self.assertRaisesRegex(ValueError, "7"):
            sheet.water = bad
        np.testing.assert_allclose(sheet.saturation, 0.5, rtol=1e-15)


class States(unittest.TestCase):
    def test_a_restored_scene_goes_on_bit_for_bit(self):
        effects = {"absorption": {"exposure": 0.3}, "wind": {"velocity_m_s": [1, 0, 2]}, "diffusion": {}}
        first = opened(effects, pins={"edges": ["top"]})
        first.step(20)
        state = first.save()
        first.step(20)
        second = opened(effects, pins={"edges": ["top"]})
        places = second.cloths[0].positions
        second.restore(state)
        self.assertEqual(second.steps, 20)
        second.step(20)
        np.testing.assert_array_equal(first.cloths[0].positions, places)
        np.testing.assert_array_equal(first.cloths[0].water, second.cloths[0].water)

    def test_what_is_no_state_changes_nothing(self):
        falling = opened()
        falling.step(8)
        state = falling.save()
        falling = opened()
        falling.step(5)
        before = falling.cloths[0].positions.copy()
        for bad in (b"", b"abc", state[:-1], state[:40], flipped(state, 2), flipped(state, len(state) // 2)):
            with self.assertRaises(wetcloth.StateError, msg=bad[:20]):
                falling.restore(bad)
            self.assertEqual(falling.steps, 5)
            np.testing.assert_array_equal(falling.cloths[0].positions, before)


class Threads(unittest.TestCase):
    def test_scenes_run_beside_each_other_as_alone(self):
        effects = {"absorption": {}, "wind": {"velocity_m_s": [1, 3, 2]}}
        alone = opened(effects)
        alone.step(60)
        scenes = [opened(effects) for _ in range(4)]
        threads = [threading.Thread(target=each.step, args=(60,)) for each in scenes]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for each in scenes:
            np.testing.assert_array_equal(each.cloths[0].positions, alone.cloths[0].positions)

    def test_one_scene_may_be_shared(self):
        alone, shared = opened(), opened()
        alone.step(40)
        threads = [threading.Thread(target=shared.step, args=(10,)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(shared.steps, 40)
        np.testing.assert_array_equal(shared.cloths[0].positions, alone.cloths[0].positions)

    def test_others_run_while_one_steps(self):
        slow = wetcloth.open({**scene(), "substeps": 1000, "step_s": 1})
        stepping = threading.Thread(target=slow.step)
        stepping.start()
        rounds = 0
        while stepping.is_alive():
            rounds += 1
        # With the interpreter's lock held in the step this thread would get no turn but before and after.
        self.assertGreater(rounds, 100)


class Waiting(unittest.TestCase):
    def test_who_waits_for_a_step_does_not_stop_others(self):
        long = {**scene({"wind": {"velocity_m_s": [0, 0, 0]}}), "substeps": 1000, "step_s": 1}
        long["cloths"][0]["patch"].update({"columns": 40, "rows": 40})  # a step takes a good part of a second
        slow = wetcloth.open(long)
        stepping = threading.Thread(target=slow.step)
        changing = threading.Thread(target=slow.cloths[0].change, args=("wind",), kwargs={"velocity_m_s": [1, 0, 0]})
        stepping.start()
        changing.start()
        time.sleep(0.02)  # it waits by now
        rounds = 0
        while stepping.is_alive():
            rounds += 1
        changing.join()
        self.assertGreater(rounds, 100)
        self.assertEqual(slow.cloths[0].effects["wind"], {"velocity_m_s": [1, 0, 0]})


class Errors(unittest.TestCase):
    def test_they_are_those_of_the_command(self):
        for wrong, words in (
            ({"wolrd": 1}, "/wolrd.*unknown key"),
            ({"step_s": -1}, "/step_s = -1.*in \\(0, 1\\]"),
            ({"world": "soft_rgid"}, 'did you mean "soft_rigid"'),
            ({"step_s": float("nan")}, "/step_s"),
        ):
            with self.assertRaisesRegex(wetcloth.InputError, words):
                wetcloth.open({**scene(), **wrong})

    def test_files_are_named(self):
        with self.assertRaisesRegex(wetcloth.InputError, "missing.json: no such file"):
            wetcloth.open("missing.json", PRECISION)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "broken.json")
            with open(file, "w", encoding="utf-8") as stream:
                stream.write('{"world": ')
            with self.assertRaisesRegex(wetcloth.InputError, "broken.json.*line 1"):
                wetcloth.open(file, PRECISION)

    def test_effects_and_pins(self):
        hanging = opened({"wind": {"velocity_m_s": [0, 0, 0]}}, pins={"corners": ["top_left"]})
        sheet = hanging.cloths[0]
        for refused, words in (
            (lambda: sheet.change("wnd"), 'did you mean "wind"'),
            (lambda: sheet.change("wind", velocity=1), "/cloths/0/effects/wind/velocity"),
            (lambda: sheet.change("wind", air_density_kg_m3=-1), "air_density_kg_m3 = -1"),
            (lambda: sheet.change("immersion"), "water"),
            (lambda: sheet.remove("rain"), '"rain"'),
            (lambda: sheet.move_pins(np.zeros((2, 3))), "must be 1"),
            (lambda: sheet.move_pins(np.zeros(3)), "shape"),
            (lambda: sheet.move_pins([[0, np.inf, 0]]), "places\\[0\\]"),
            (lambda: hanging.step(0), "steps = 0"),
            (lambda: hanging.step(-3), "steps = -3"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                refused()
        self.assertEqual(sheet.effects, {"wind": {"velocity_m_s": [0, 0, 0]}})
        with self.assertRaises(KeyError):
            hanging["shet"]

    def test_a_cloth_that_the_scene_moves_is_left_to_it(self):
        motion = {"times_s": [0, 1], "offsets_m": [[0, 0, 0], [0, 1, 0]]}
        sheet = opened(pins={"corners": ["top_left"]}, motion=motion).cloths[0]
        with self.assertRaisesRegex(ValueError, "motion"):
            sheet.move_pins(sheet.positions[sheet.pins])

    def test_one_process_has_one_precision(self):
        opened()
        with self.assertRaisesRegex(RuntimeError, "another process"):
            wetcloth.open(scene(), OTHER)
        with self.assertRaisesRegex(wetcloth.InputError, "float16"):
            wetcloth.open(scene(), "float16")


class Words(unittest.TestCase):
    def test_they_say_what_they_are(self):
        one = opened()
        self.assertEqual(repr(one), "<wetcloth.Scene 'scene', %s, 1 cloths, t = 0 s>" % PRECISION)
        self.assertEqual(repr(one.cloths[0]), "<wetcloth.Cloth 'sheet', 36 nodes, 0 kg of water>")

    def test_everything_is_explained(self):
        for kind in (type(opened()), type(opened().cloths[0])):
            for name in dir(kind):
                if not name.startswith("_"):
                    self.assertGreater(len(getattr(kind, name).__doc__ or ""), 10, name)


class Scenes(unittest.TestCase):
    def test_those_that_go_with_the_package_are_found(self):
        self.assertTrue((wetcloth.scene_folder() / "wick_strip.json").is_file())
        strip = wetcloth.open("wick_strip.json", PRECISION)
        self.assertEqual(strip.name, "wick_strip")
        strip.step()


if __name__ == "__main__":
    unittest.main()
