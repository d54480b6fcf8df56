#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws rings.png: the rings of a planet from their inner edge (left) to the outer one, one pixel high, with alpha.

Not those of any planet: bands of ice with gaps, by a few sums of noise. Needs python3-numpy.
"""
import pathlib
import struct
import zlib

import numpy

WIDTH = 2048
FOLDER = pathlib.Path(__file__).parent


def noise(random, octaves):
    """Sums of smoothed noise from coarse to fine, from 0 to 1."""
    total = numpy.zeros(WIDTH)
    for octave in octaves:
        knots = random.random(2**octave + 1)
        total += numpy.interp(numpy.linspace(0, 2**octave, WIDTH), numpy.arange(2**octave + 1), knots) / len(octaves)
    return (total - total.min()) / (total.max() - total.min())


def write_png(path, rgba):
    """One row of 8 bit pixels with straight alpha."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, 1, 8, 6, 0, 0, 0))
                     + chunk(b"sRGB", b"\0") + chunk(b"IDAT", zlib.compress(b"\0" + rgba, 9)) + chunk(b"IEND", b""))


def main():
    random = numpy.random.default_rng(4)
    x = numpy.linspace(0, 1, WIDTH)
    density = 0.25 + 0.75 * noise(random, [2, 4, 6, 8])
    for middle, width in ((0.22, 0.008), (0.61, 0.035), (0.83, 0.006)):  # gaps
        density *= 1 - numpy.exp(-((x - middle) / width) ** 4)
    density *= numpy.clip(x / 0.06, 0, 1) * numpy.clip((1 - x) / 0.03, 0, 1)
    tint = noise(random, [3, 5])[:, None]
    colour = (1 - tint) * numpy.array([0.78, 0.68, 0.55]) + tint * numpy.array([0.92, 0.88, 0.80])
    pixels = numpy.concatenate([colour, density[:, None]], axis=1)
    write_png(FOLDER / "rings.png", (pixels * 255 + 0.5).astype(numpy.uint8).tobytes())


main()
