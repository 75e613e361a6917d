#!/usr/bin/env python3
# SPDX-License-Identifier: Zlib
"""The page to try the library on, from a local server in a headless Chromium: it loads, steps, draws, a drag moves the
cloth, every scene runs, and nothing is logged as an error. Prints its size and its pictures a second.

web_test.py SITE
"""

import functools
import gzip
import http.server
import os
import pathlib
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / 'readers'))
import chromium  # noqa: E402
import picture  # noqa: E402

WIDTH, HEIGHT = 960, 540
STAGE = (640, 540)  # the picture, at the left of the panel
MOST_BYTES = 1000000  # compressed, as a server sends it


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, '.js': 'text/javascript',
                      '.wasm': 'application/wasm'}

    def log_message(self, *_):
        pass


def serve(site):
    server = http.server.ThreadingHTTPServer(('127.0.0.1', 0), functools.partial(Quiet, directory=site))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return 'http://127.0.0.1:%d/' % server.server_address[1]


def check(condition, complaint):
    if not condition:
        raise AssertionError(complaint)


def test_size(site):
    files = [file for file in pathlib.Path(site).iterdir() if file.is_file()]
    size = sum(len(gzip.compress(file.read_bytes(), 9)) for file in files)
    print('compressed, without the scenes: %d bytes' % size)
    check(size <= MOST_BYTES, 'the page is larger than %d bytes' % MOST_BYTES)


def state(browser):
    return browser.evaluate('wetcloth.state()')


def is_red(red, green, blue):
    return red > green + 30 and red > blue + 30


def shown(browser):
    return picture.Picture(browser.screenshot(0, 0, *STAGE))


def test_runs(browser):
    time.sleep(8)  # until it draws as finely as the machine can
    before, pictures, start = state(browser), browser.evaluate('wetcloth.pictures'), time.monotonic()
    time.sleep(5)
    after = state(browser)
    rate = (browser.evaluate('wetcloth.pictures') - pictures) / (time.monotonic() - start)
    print('flag of 48 x 48 nodes with wind and absorption: %.0f pictures a second, %.2f of real time, a step %.1f ms'
          % (rate, (after['time'] - before['time']) / (time.monotonic() - start),
             (after['library'] + after['bullet']) / 1000))
    check(after['time'] > before['time'], 'no time has passed')
    check(after['water'] > before['water'], 'it takes up no water')
    check(any(effect['key'] == 'wind' and effect['microseconds'] > 0 for effect in after['effects']), 'no costs')


def test_draws(browser):
    share = shown(browser).share(is_red)
    check(0.03 < share < 0.9, '%g of the picture is flag' % share)


def middle(browser):
    places = browser.evaluate('wetcloth.positions()')
    return [sum(places[axis::3]) / (len(places) // 3) for axis in range(3)]


def test_is_dragged(browser):
    browser.evaluate('for (const axis of ["x", "y", "z"]) { const at = document.getElementById("wind-" + axis);'
                     ' at.value = 0; at.dispatchEvent(new Event("input")); }')
    time.sleep(3)  # it hangs down
    browser.evaluate('document.getElementById("pause").click()')
    time.sleep(0.5)
    still = middle(browser)
    hung = shown(browser)
    inside = [(x, y) for y in range(20, STAGE[1] - 20, 4) for x in range(20, STAGE[0] - 20, 4)
              if all(is_red(*hung.pixel(x + dx, y + dy)) for dx in (-12, 0, 12) for dy in (-12, 0, 12))]
    check(inside, 'there is no flag to take')
    place = max(inside)  # near the edge that hangs freely
    goal = (place[0] + 150, place[1] - 150)
    browser.take(place, goal)
    browser.evaluate('document.getElementById("pause").click()')
    time.sleep(2)
    pulled = middle(browser)
    browser.let_go(goal)
    check(browser.evaluate('wetcloth.drags') == 1, 'the cloth was not taken')
    check(pulled[0] > still[0] + 0.05, 'it went from %s to %s' % (still, pulled))


def test_beside(browser):
    before = browser.evaluate('document.getElementById("picture").clientWidth')
    browser.evaluate('document.getElementById("compared").click()')
    time.sleep(1)
    check(browser.evaluate('document.getElementById("plain").width') > 20, 'plain Bullet is not drawn')
    check(browser.evaluate('document.getElementById("picture").clientWidth') < before, 'the picture was not made narrower')
    browser.evaluate('document.getElementById("compared").click()')


def test_controls(browser):
    browser.evaluate('document.getElementById("effect-wind").click()')
    time.sleep(0.3)
    check(not any(effect['key'] == 'wind' and effect['on'] for effect in state(browser)['effects']), 'wind is still on')
    browser.evaluate('{ const at = document.getElementById("fabric"); at.value = "coarse_wool";'
                     ' at.dispatchEvent(new Event("change")); }')
    check(state(browser)['time'] < 1, 'another fabric begins anew')
    check(not state(browser)['waits'], 'the fabric waits')


def test_scenes(browser, names):
    for name in names:
        browser.evaluate('wetcloth.load("%s")' % name)
        time.sleep(0.5)
        now = state(browser)
        check(now['time'] > 0 and not now['failure'], '%s: %s' % (name, now))
        check(not browser.errors, '%s: %s' % (name, browser.errors))


def main():
    site = sys.argv[1]
    if not chromium.find() or picture.cannot_be_read():
        print(picture.cannot_be_read() or 'Chromium is not installed (Debian: apt install chromium)')
        sys.exit(77)
    test_size(site)
    names = sorted(file.stem for file in (pathlib.Path(site) / 'scenes').glob('*.json') if file.stem != 'index')
    with chromium.Browser(WIDTH, HEIGHT) as browser:
        browser.go(serve(site), 'window.wetcloth !== undefined && wetcloth.ready')
        test_runs(browser)
        test_draws(browser)
        if len(sys.argv) > 2:
            pathlib.Path(sys.argv[2]).write_bytes(browser.screenshot(0, 0, WIDTH, HEIGHT))
        test_is_dragged(browser)
        test_beside(browser)
        test_controls(browser)
        test_scenes(browser, names)
        check(not browser.errors, browser.errors)
    print('the page works')


if __name__ == '__main__':
    main()
