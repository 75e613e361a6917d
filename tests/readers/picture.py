# SPDX-License-Identifier: Zlib
"""Pictures, read by ffmpeg: Python's own library has no reader, and one written in Python is slow."""

import operator
import shutil
import struct
import subprocess


def cannot_be_read():
    """Why not, or None."""
    return None if shutil.which('ffmpeg') else 'ffmpeg is not installed (Debian: apt install ffmpeg)'


class Picture:
    """What the bytes of a PNG show; pixels are (red, green, blue), row by row."""

    def __init__(self, png):
        assert png[:8] == b'\x89PNG\r\n\x1a\n', png[:8]
        self.width, self.height = struct.unpack_from('>II', png, 16)
        command = ['ffmpeg', '-v', 'error', '-f', 'png_pipe', '-i', '-', '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-']
        channels = iter(subprocess.run(command, input=png, check=True, stdout=subprocess.PIPE).stdout)
        self.pixels = list(zip(channels, channels, channels))
        assert len(self.pixels) == self.width * self.height, len(self.pixels)

    def pixel(self, x, y):
        return self.pixels[y * self.width + x]

    def share(self, wanted):
        """Of its pixels, those for which wanted(red, green, blue) is true."""
        return sum(wanted(*pixel) for pixel in self.pixels) / len(self.pixels)

    def differing(self, other, tolerance=0):
        """Number of pixels in which a channel differs by more than the tolerance, of 255."""
        unequal = map(operator.ne, self.pixels, other.pixels)
        if tolerance == 0:
            return sum(unequal)
        return sum(
            max(abs(a - b) for a, b in zip(one, another)) > tolerance
            for one, another, differ in zip(self.pixels, other.pixels, unequal)
            if differ
        )
