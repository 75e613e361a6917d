# SPDX-License-Identifier: Zlib
"""The page of `wetcloth render`, in a headless Chromium: it loads, draws, scrubs, plays, and logs no error."""

import json
import os
import struct
import time

import chromium
import picture
from exported import SOURCE_DIR, check, export, near, path, prepare, skip, wetcloth

if not chromium.find():
    skip('Chromium is not installed (Debian: apt install chromium)')
if picture.cannot_be_read():
    skip(picture.cannot_be_read())

TITLE = 'a towel </script> & <b>{{bytes}}'
SIZE = (840, 380)  # of the window; the picture is on its left
PICTURE = (480, 300)


def towel():
    """A terry towel, orange, half of it in water, in wind; 33 x 49 nodes."""
    with open(os.path.join(SOURCE_DIR, 'examples', 'scenes', 'hanging_towel.json')) as file:
        content = json.load(file)
    content['name'] = TITLE
    content.pop('$schema')
    with open(path('scene.json'), 'w') as file:
        json.dump(content, file)
    return path('scene.json')


def pictured(browser):
    time.sleep(0.3)  # what was asked for is drawn with the next refresh
    return picture.Picture(browser.screenshot(0, 0, *PICTURE))


def changed(before, after):
    """Share of pixels that differ by more than compression of colours could."""
    return before.differing(after, 12) / len(before.pixels)


def is_orange(red, green, blue):
    return red > green + 25 and green > blue + 10


def test_fetches_nothing(page):
    with open(page) as file:
        text = file.read()
    places = text.count('http://') + text.count('https://')
    check(places == text.count('http://www.w3.org/2000/svg') == 1, 'the page names other places')


def test_draws(browser):
    check(browser.evaluate('document.title') == TITLE, 'title: ' + browser.evaluate('document.title'))
    first = pictured(browser)
    check(first.share(is_orange) > 0.05, 'only %g of the picture is towel' % first.share(is_orange))
    check(first.share(is_orange) < 0.9, 'there is nothing around the towel')
    plots = browser.evaluate('document.querySelectorAll(".plot polyline").length')
    check(plots >= 4, 'lines in plots: %d' % plots)
    return first


def test_scrubs(browser, first, frames):
    browser.evaluate('wetcloth.setFrame(%d)' % (frames - 1))
    check(browser.evaluate('wetcloth.frame') == frames - 1, 'setFrame')
    last = pictured(browser)
    check(changed(first, last) > 0.01, 'the picture stays when the frame changes')
    browser.evaluate('const scrub = document.getElementById("scrub"); scrub.value = 10;'
                     'scrub.dispatchEvent(new Event("input"))')
    check(browser.evaluate('wetcloth.frame') == 10, 'the slider')
    browser.press('ArrowRight', 'ArrowRight')
    check(browser.evaluate('wetcloth.frame') == 11, 'the arrow key')
    browser.press('Home', 'Home')
    check(browser.evaluate('wetcloth.frame') == 0, 'the key Home')
    check(changed(first, pictured(browser)) < 0.001, 'the first frame looks otherwise the second time')


def test_plays(browser):
    browser.press(' ', 'Space')
    end = time.monotonic() + 20
    while browser.evaluate('wetcloth.frame') < 3 and time.monotonic() < end:
        time.sleep(0.1)
    check(browser.evaluate('wetcloth.frame') >= 3, 'it does not play')
    browser.press(' ', 'Space')


def test_orbits_and_colours(browser, frames):
    browser.evaluate('wetcloth.setFrame(%d)' % (frames - 1))
    before = pictured(browser)
    browser.drag((100, 150), (220, 130))
    turned = pictured(browser)
    check(changed(before, turned) > 0.02, 'dragging does not turn the view')
    browser.press('2', 'Digit2')
    coloured = pictured(browser)
    check(coloured.share(is_orange) < 0.01, 'the towel keeps its own colour')
    check(changed(turned, coloured) > 0.05, 'colours by saturation look like the fabric')
    check(not browser.evaluate('document.getElementById("scale").hidden'), 'there is no colour bar')


def test_state(browser, frames, scene_file):
    """The page's packed positions against the point cache."""
    folder, _ = export(scene_file, 'obj_pc2', 'obj', '--duration', '2')
    with open(os.path.join(folder, 'towel.pc2'), 'rb') as file:
        cache = file.read()
    points = struct.unpack_from('<i', cache, 16)[0]
    for frame in (0, frames // 2, frames - 1):
        browser.evaluate('wetcloth.setFrame(%d)' % frame)
        state = browser.evaluate('wetcloth.state()')[0]
        expected = struct.unpack_from('<%df' % (3 * points), cache, 32 + 12 * points * frame)
        worst = max(abs(a - b) for a, b in zip(state['positions'], expected))
        check(worst < 5e-5, 'frame %d: positions are off by up to %g m' % (frame, worst))
    run = wetcloth('run', scene_file, '--duration', '2')
    near(max(state['saturation']), run['saturation']['max'], 0.5 / 255 + 1e-6, 'greatest saturation')


def test_dark(browser, page):
    browser.prefer('dark')
    browser.open(page, 'window.wetcloth && window.wetcloth.ready')
    panel = picture.Picture(browser.screenshot(540, 0, SIZE[0] - 540, SIZE[1])).pixels
    mean = sum(map(sum, panel)) / (3 * len(panel))
    check(mean < 80, 'the panel is bright in the dark scheme: %g' % mean)


prepare()
scene_file = towel()
page = path('towel.html')
frames = wetcloth('render', scene_file, '--out', page, '--duration', '2', '--fps', '60')['frames']
test_fetches_nothing(page)
with chromium.Browser(*SIZE) as browser:
    browser.open(page, 'window.wetcloth && window.wetcloth.ready')
    check(browser.evaluate('wetcloth.frames') == frames, 'frames')
    first = test_draws(browser)
    test_scrubs(browser, first, frames)
    test_plays(browser)
    test_orbits_and_colours(browser, frames)
    test_state(browser, frames, scene_file)
    test_dark(browser, page)
    check(not browser.errors, browser.errors)
