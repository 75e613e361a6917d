# SPDX-License-Identifier: Zlib
"""The window of `wetcloth view`, on a display of its own (Xvfb), with real keys and a real mouse (xdotool).

    window_test.py WETCLOTH SCENES_DIRECTORY

Ends with status 77 where Xvfb or xdotool is missing."""

import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

WETCLOTH, SCENES = sys.argv[1], sys.argv[2]
SKIPPED = 77
PATIENCE = 60  # seconds, for a machine that is busy


class Picture:
    """A PNG with eight bits each of red, green and blue."""

    def __init__(self, file):
        with open(file, "rb") as stream:
            data = stream.read()
        assert data[:8] == b"\x89PNG\r\n\x1a\n", file
        self.width, self.height, depth, colour = struct.unpack(">IIBB", data[16:26])
        assert (depth, colour) == (8, 2), (depth, colour)
        packed, at = b"", 8
        while at < len(data):
            (size,) = struct.unpack(">I", data[at : at + 4])
            if data[at + 4 : at + 8] == b"IDAT":
                packed += data[at + 8 : at + 8 + size]
            at += size + 12
        self.rows = self._unfiltered(zlib.decompress(packed))

    def _unfiltered(self, raw):
        stride = 3 * self.width
        rows, above = [], bytes(stride)
        for start in range(0, self.height * (stride + 1), stride + 1):
            row = bytearray(raw[start + 1 : start + 1 + stride])
            self._UNFILTER[raw[start]](row, above)
            rows.append(bytes(row))
            above = row
        return rows

    @staticmethod
    def _sub(row, _):
        for i in range(3, len(row)):
            row[i] = (row[i] + row[i - 3]) & 255

    @staticmethod
    def _up(row, above):
        row[:] = bytes((a + b) & 255 for a, b in zip(row, above))

    @staticmethod
    def _average(row, above):
        for i, up in enumerate(above):
            row[i] = (row[i] + ((row[i - 3] if i >= 3 else 0) + up) // 2) & 255

    @staticmethod
    def _paeth(row, above):
        for i, up in enumerate(above):
            left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
            guess = left + up - corner
            to_left, to_up, to_corner = abs(guess - left), abs(guess - up), abs(guess - corner)
            nearest = left if to_left <= to_up and to_left <= to_corner else up if to_up <= to_corner else corner
            row[i] = (row[i] + nearest) & 255

    _UNFILTER = [lambda row, above: None, _sub.__func__, _up.__func__, _average.__func__, _paeth.__func__]

    def pixel(self, x, y):
        return tuple(self.rows[y][3 * x : 3 * x + 3])

    def colours(self):
        return len({bytes(row[i : i + 3]) for row in self.rows for i in range(0, len(row), 3)})

    def differing(self, other):
        """Number of pixels that differ."""
        return sum(
            own[i : i + 3] != theirs[i : i + 3]
            for own, theirs in zip(self.rows, other.rows)
            if own != theirs
            for i in range(0, len(own), 3)
        )


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
        return dict(os.environ, DISPLAY=self.name, LIBGL_ALWAYS_SOFTWARE="1")

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
        return Picture(file)

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
        picture = Picture(file)
        self.assertEqual((picture.width, picture.height), (800, 600))
        self.assertGreater(picture.colours(), 500)
        background, cloth = picture.pixel(5, 5), picture.pixel(235, 300)
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
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = self.run_to_the_end(os.path.join(SCENES, "hanging_towel.json"), environment=environment)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("no window could be opened", done.stderr)
        self.assertIn("wetcloth render", done.stderr)

    def test_how_fast_it_is(self):
        scene = towel(self.folder, 64, {"absorption": {"exposure": 1}, "wind": {"velocity_m_s": [0, 0, 3]}})
        done = self.run_to_the_end(scene, "--frames", "60", "--size", "1280x720", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        print("64 x 64 nodes, 1280x720: %.1f pictures a second" % json.loads(done.stdout)["frames_per_second"])


if __name__ == "__main__":
    for program in ["Xvfb", "xdotool"]:
        if shutil.which(program) is None:
            print("skipped: there is no %s (Debian: apt install xvfb xdotool)" % program)
            sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
