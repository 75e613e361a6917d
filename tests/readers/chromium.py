# SPDX-License-Identifier: Zlib
"""Drives a headless Chromium through its DevTools protocol, over pipes: nothing but Python's own library."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

FLAGS = [
    '--headless=new', '--no-sandbox', '--no-first-run', '--disable-quic', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--disable-default-apps', '--disable-extensions', '--mute-audio',
    '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--hide-scrollbars',
    '--remote-debugging-pipe',
]


def find():
    """The path of a Chromium, or None."""
    for name in ('chromium', 'chromium-browser', 'google-chrome'):
        if shutil.which(name):
            return shutil.which(name)
    return None


class Browser:
    """One page in a browser of its own; use it in a `with` statement."""

    def __init__(self, width=900, height=600):
        self.errors = []  # what the page logged as an error or threw
        self._profile = tempfile.mkdtemp(prefix='chromium-')
        self._next = 0
        self._pending = b''
        ours, theirs = os.pipe(), os.pipe()  # what we write; what it writes
        os.set_inheritable(ours[0], True)
        os.set_inheritable(theirs[1], True)
        # DevTools reads file descriptor 3 and writes to 4.
        command = 'exec 3<&%d 4>&%d; exec "$@"' % (ours[0], theirs[1])
        self._process = subprocess.Popen(
            ['bash', '-c', command, 'bash', find(), '--user-data-dir=' + self._profile,
             '--window-size=%d,%d' % (width, height), *FLAGS, 'about:blank'],
            pass_fds=(ours[0], theirs[1]), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(ours[0])
        os.close(theirs[1])
        self._out, self._in = ours[1], theirs[0]
        self._session = None
        targets = self._call('Target.getTargets')['targetInfos']
        page = next(target for target in targets if target['type'] == 'page')
        self._session = self._call('Target.attachToTarget', targetId=page['targetId'], flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log'):
            self._call(domain + '.enable')
        self.prefer('light')
        self._call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1,
                   mobile=False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        # It ends its own helpers when it is asked to; they would go on writing to the profile otherwise.
        os.write(self._out, json.dumps({'id': self._next + 1, 'method': 'Browser.close'}).encode() + b'\0')
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._out)
        os.close(self._in)
        shutil.rmtree(self._profile, ignore_errors=True)

    def open(self, file, ready, seconds=60):
        """Opens a file and waits until the expression `ready` is true or the page says an error."""
        self.go('file://' + os.path.abspath(file), ready, seconds)

    def go(self, url, ready, seconds=60):
        """The same of any address."""
        self._call('Page.navigate', url=url)
        end = time.monotonic() + seconds
        while time.monotonic() < end and not self.errors:
            if self.evaluate(ready):
                return
            time.sleep(0.1)
        raise AssertionError('not ready: %s' % (self.errors or ready))

    def prefer(self, scheme):
        """Pages see that their reader wants them 'light' or 'dark'."""
        self._call('Emulation.setEmulatedMedia', features=[{'name': 'prefers-color-scheme', 'value': scheme}])

    def evaluate(self, expression):
        answer = self._call('Runtime.evaluate', expression=expression, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in answer:
            raise AssertionError(answer['exceptionDetails'].get('exception', {}).get('description', answer))
        return answer['result'].get('value')

    def press(self, key, code):
        for kind in ('keyDown', 'keyUp'):
            self._call('Input.dispatchKeyEvent', type=kind, key=key, code=code)

    def drag(self, start, end):
        self.take(start, end)
        self.let_go(end)

    def take(self, start, end):
        """Drags, and does not let go yet."""
        self._mouse('mousePressed', start, 1)
        self._mouse('mouseMoved', end, 1)

    def let_go(self, place):
        self._mouse('mouseReleased', place, 0)

    def screenshot(self, left, top, width, height):
        """PNG of that part of the window."""
        clip = {'x': left, 'y': top, 'width': width, 'height': height, 'scale': 1}
        return base64.b64decode(self._call('Page.captureScreenshot', format='png', clip=clip)['data'])

    def _mouse(self, kind, place, buttons):
        self._call('Input.dispatchMouseEvent', type=kind, x=place[0], y=place[1], button='left', buttons=buttons,
                   clickCount=1)

    def _call(self, method, **parameters):
        self._next += 1
        message = {'id': self._next, 'method': method, 'params': parameters}
        if self._session:
            message['sessionId'] = self._session
        os.write(self._out, json.dumps(message).encode() + b'\0')
        while True:
            answer = self._read()
            if answer.get('id') == self._next:
                if 'error' in answer:
                    raise AssertionError('%s: %s' % (method, answer['error']))
                return answer['result']
            self._note(answer)

    def _read(self):
        while b'\0' not in self._pending:
            more = os.read(self._in, 1 << 20)
            if not more:
                raise AssertionError('the browser ended')
            self._pending += more
        message, self._pending = self._pending.split(b'\0', 1)
        return json.loads(message)

    def _note(self, event):
        parameters = event.get('params', {})
        if event.get('method') == 'Runtime.exceptionThrown':
            self.errors.append(json.dumps(parameters['exceptionDetails'])[:2000])
        if event.get('method') == 'Runtime.consoleAPICalled' and parameters['type'] in ('error', 'assert'):
            self.errors.append(json.dumps(parameters['args'])[:2000])
        if event.get('method') == 'Log.entryAdded' and parameters['entry']['level'] == 'error':
            self.errors.append(parameters['entry']['text'])
