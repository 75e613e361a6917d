# SPDX-License-Identifier: Zlib
"""The window of `wetcloth view`, on a display of its own (Xvfb), with real keys and a real mouse (xdotool).

    PYTHONPATH=tests/readers window_test.py WETCLOTH SCENES_DIRECTORY

Ends with status 77 where Xvfb, xdotool or ffmpeg is missing."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import picture

WETCLOTH, SCENES = sys.argv[1], sys.argv[2]
SKIPPED = 77
PATIENCE = 60  # seconds, for a machine that is busy
# Without it Wayland's library, which newer GLFW asks first, writes a line of its own.
ENVIRONMENT = {"XDG_RUNTIME_DIR": tempfile.gettempdir(), **os.environ}


def read(file):
    with open(file, "rb") as stream:
        return picture.Picture(stream.read())


class Display:
    """An X server that shows nothing."""

    def __init__(self):
        ours, its = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(its), "-screen", "0", "1280x800x24", "-nolisten", "tcp"],
            pass_fds=[its],
            stderr=subprocess.DEVNULL,
        )
        os.close(its)
        with os.fdopen(ours) as stream:
            self.name = ":" + stream.readline().strip()

    def environment(self):
        # A window draws as often as it can: one thread of it is enough beside other tests.
        return dict(ENVIRONMENT, DISPLAY=self.name, LIBGL_ALWAYS_SOFTWARE="1", LP_NUM_THREADS="1")

    def close(self):
        self.server.terminate()
        self.server.wait()


class Window:
    """`wetcloth view`, as somebody uses it."""

    def __init__(self, display, folder, scene, *options):
        self.folder, self.environment, self.pictures = folder, display.environment(), 0
        self.json = os.path.join(folder, "state.json")
        self.program = subprocess.Popen(
            [WETCLOTH, "view", scene, "--size", "640x480", "--json", self.json, *options],
            cwd=folder,
            env=self.environment,
            stderr=subprocess.PIPE,
        )
        self.xdotool("search", "--sync", "--name", "^wetcloth: ")
        self.xdotool("mousemove", "20", "20")  # keys go to the window under the pointer

    def xdotool(self, *words):
        subprocess.run(["xdotool", *words], check=True, env=self.environment, stdout=subprocess.DEVNULL, timeout=PATIENCE)

    def key(self, *names):
        for name in names:
            self.xdotool("key", name)

    def picture(self):
        """What the window shows; all keys before it have been taken."""
        self.pictures += 1
        file = os.path.join(self.folder, "wetcloth_%04d.png" % self.pictures)
        self.key("p")
        end = time.monotonic() + PATIENCE
        while not os.path.exists(file):
            assert time.monotonic() < end and self.program.poll() is None, "no picture"
            time.sleep(0.02)
        return read(file)

    def quit(self):
        """Closes it with Esc; returns how it was left."""
        self.key("Escape")
        _, errors = self.program.communicate(timeout=PATIENCE)
        assert (self.program.returncode, errors) == (0, b""), (self.program.returncode, errors)
        with open(self.json) as stream:
            return json.load(stream)

    def close(self):
        if self.program.poll() is None:
            self.program.kill()
        self.program.wait()
        self.program.stderr.close()


def towel(folder, nodes=12, effects=None):
    """A square towel that hangs still by its upper edge; the camera looks straight at it."""
    scene = {
        "world": "soft_rigid",
        "step_s": 0.016667,
        "cloths": [
            {
                "patch": {"columns": nodes, "rows": nodes, "edge_u_m": [1, 0, 0], "edge_v_m": [0, 1, 0]},
                "fabric": "cotton",
                "pins": {"edges": ["top"]},
                "damping": 0.02,
                "effects": effects or {},
            }
        ],
        "camera": {"direction": [0, 0, -1]},
    }
    file = os.path.join(folder, "towel.json")
    with open(file, "w") as stream:
        json.dump(scene, stream)
    return file


class WindowTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.display = Display()

    @classmethod
    def tearDownClass(cls):
        cls.display.close()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def open(self, scene, *options):
        window = Window(self.display, self.folder, scene, *options)
        self.addCleanup(window.close)
        return window

    def run_to_the_end(self, *words, environment=None):
        return subprocess.run(
            [WETCLOTH, "view", *words],
            env=environment or self.display.environment(),
            capture_output=True,
            text=True,
            timeout=PATIENCE,
        )

    def test_shows_the_scene_and_closes_after_so_many_pictures(self):
        file = os.path.join(self.folder, "picture.png")
        scene = os.path.join(SCENES, "hanging_towel.json")
        done = self.run_to_the_end(scene, "--frames", "3", "--size", "800x600", "--screenshot", file, "--json", "-")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        state = json.loads(done.stdout)
        self.assertEqual((state["frames"], state["steps"], state["drags"]), (3, 3, 0))
        self.assertEqual(state["effects"], ["absorption", "wind"])
        shown = read(file)
        self.assertEqual((shown.width, shown.height), (800, 600))
        self.assertGreater(len(set(shown.pixels)), 500)
        background, cloth = shown.pixel(5, 5), shown.pixel(235, 300)
        self.assertGreater(sum(abs(a - b) for a, b in zip(background, cloth)), 60)

    def test_space_pauses_and_goes_on(self):
        window = self.open(towel(self.folder, effects={"wind": {"velocity_m_s": [0, 0, -4]}}))
        window.key("h", "space")
        first, second = window.picture(), window.picture()
        self.assertEqual(first.differing(second), 0)
        window.key("space")
        self.assertGreater(window.picture().differing(first), 100)
        window.key("space")
        state = window.quit()
        self.assertTrue(state["paused"])
        self.assertGreater(state["time_s"], 0)

    def test_single_steps_reset_slow_motion_and_comparison(self):
        window = self.open(towel(self.folder), "--paused")
        for _ in range(2):
            window.key("n")
            window.picture()
        window.key("period", "s", "c")
        one = window.picture()
        state = window.quit()
        self.assertEqual((state["steps"], state["slow_motion"], state["compare"]), (3, True, True))
        window = self.open(towel(self.folder), "--paused", "--compare")
        window.pictures = 3
        window.key("n", "n", "r", "c")
        other = window.picture()
        self.assertGreater(other.differing(one), 1000)
        state = window.quit()
        self.assertEqual((state["steps"], state["slow_motion"], state["compare"]), (0, False, False))

    def test_keys_choose_what_the_colours_mean(self):
        window = self.open(towel(self.folder, effects={"absorption": {"exposure": 1}}))
        window.key("h", "space")
        pictures = [window.picture()]
        for key in ["2", "3", "4"]:
            window.key(key)
            pictures.append(window.picture())
            self.assertGreater(pictures[-1].differing(pictures[-2]), 1000, key)
        self.assertEqual(window.quit()["colouring"], "speed")

    def test_the_mouse_drags_the_cloth(self):
        window = self.open(towel(self.folder))
        window.key("h")
        before = window.picture()
        window.xdotool("mousemove", "320", "280", "mousedown", "1")
        window.picture()
        for x in range(330, 430, 10):
            window.xdotool("mousemove", str(x), "280")
        held = window.picture()
        time.sleep(0.5)
        held = window.picture()
        self.assertGreater(held.differing(before), 1000)
        window.xdotool("mouseup", "1")
        window.picture()
        window.xdotool("mousemove", "20", "20")
        state = window.quit()
        self.assertEqual(state["drags"], 1)

    def test_the_mouse_orbits_moves_and_zooms_beside_the_cloth(self):
        window = self.open(towel(self.folder), "--paused")
        window.key("h")
        seen = [("at first", window.picture())]
        for button, task in [("1", "orbit"), ("3", "move"), ("2", "move with the middle button")]:
            window.xdotool("mousemove", "30", "100", "mousedown", button)
            window.picture()
            window.xdotool("mousemove", "70", "140")
            window.picture()
            window.xdotool("mouseup", button)
            seen.append((task, window.picture()))
        window.xdotool("click", "4")
        window.picture()
        seen.append(("zoom", window.picture()))
        for (_, before), (task, after) in zip(seen, seen[1:]):
            self.assertGreater(after.differing(before), 1000, task)
        self.assertEqual(window.quit()["drags"], 0)

    def test_without_a_display_one_line_says_so(self):
        environment = {name: value for name, value in ENVIRONMENT.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = self.run_to_the_end(os.path.join(SCENES, "hanging_towel.json"), environment=environment)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("no window could be opened", done.stderr)
        self.assertIn("wetcloth render", done.stderr)

    def test_how_fast_it_is(self):
        scene = towel(self.folder, 64, {"absorption": {"exposure": 1}, "wind": {"velocity_m_s": [0, 0, 3]}})
        done = self.run_to_the_end(scene, "--frames", "5", "--size", "1280x720", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        print("64 x 64 nodes, 1280x720: %.1f pictures a second" % json.loads(done.stdout)["frames_per_second"])


if __name__ == "__main__":
    for program in ["Xvfb", "xdotool"]:
        if shutil.which(program) is None:
            print("skipped: there is no %s (Debian: apt install xvfb xdotool)" % program)
            sys.exit(SKIPPED)
    if picture.cannot_be_read():
        print("skipped: " + picture.cannot_be_read())
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
