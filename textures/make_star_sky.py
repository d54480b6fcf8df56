#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws stars_hipparcos.csv as a lat-long sky, stars_sky.png: what a layer of type latlong can show of the stars.

Behind them lies the glow of the Milky Way: the number of stars in the catalogue, blurred over a few degrees.
Every star is a small Gaussian of constant angular width; its brightness follows its magnitude, its colour B - V (as a
blackbody, roughly). s = 0.5 is right ascension 0, s grows with falling right ascension, as the sky is seen from inside;
t = 1 is the celestial north pole. Needs python3-numpy and oiiotool.
"""
import csv
import math
import pathlib
import subprocess

import numpy

WIDTH, HEIGHT = 4096, 2048
SIGMA = 0.75  # pixels at the equator
FOLDER = pathlib.Path(__file__).parent


def colour(b_v):
    """Linear red, green, blue of a star, green 1."""
    temperature = 4600 * (1 / (0.92 * b_v + 1.7) + 1 / (0.92 * b_v + 0.62))
    planck = [math.expm1(14388 / 0.55 / temperature) / math.expm1(14388 / w / temperature) * (0.55 / w) ** 5
              for w in (0.61, 0.55, 0.465)]
    white = [math.expm1(14388 / 0.55 / 6500) / math.expm1(14388 / w / 6500) * (0.55 / w) ** 5
             for w in (0.61, 0.55, 0.465)]
    return numpy.array([p / w for p, w in zip(planck, white)])


def draw(sky, ra_deg, dec_deg, flux):
    x = (0.5 - ra_deg / 360) % 1 * WIDTH
    y = (0.5 - dec_deg / 180) * HEIGHT
    stretch = 1 / max(math.cos(math.radians(dec_deg)), 1e-2)
    rows = numpy.arange(int(y) - 4, int(y) + 5)
    reach = int(4 * stretch) + 1
    columns = numpy.arange(int(x) - reach, int(x) + reach + 1)
    in_y = numpy.exp(-((rows + 0.5 - y) ** 2) / (2 * SIGMA**2))
    in_x = numpy.exp(-((columns + 0.5 - x) ** 2) / (2 * (SIGMA * stretch) ** 2))
    keep = (rows >= 0) & (rows < HEIGHT)
    patch = in_y[keep, None, None] * in_x[None, :, None] * flux
    numpy.add.at(sky, (rows[keep][:, None], columns[None, :] % WIDTH), patch)


def glow(stars):
    """Light of the stars that are too faint to be drawn: where there are many bright ones there are many faint ones."""
    height, width = HEIGHT // 8, WIDTH // 8
    ra, dec = numpy.radians(numpy.array([(float(s["ra_deg"]), float(s["dec_deg"])) for s in stars])).T
    points = numpy.stack([numpy.cos(dec) * numpy.cos(ra), numpy.cos(dec) * numpy.sin(ra), numpy.sin(dec)], axis=1)
    longitude = (0.5 - (numpy.arange(width) + 0.5) / width) * 2 * math.pi
    latitude = (0.5 - (numpy.arange(height) + 0.5) / height) * math.pi
    density = numpy.zeros((height, width))
    for row, lat in enumerate(latitude):
        near = points[abs(dec - lat) < math.radians(12)]
        cosine = numpy.cos(lat) * (numpy.outer(numpy.cos(longitude), near[:, 0]) +
                                   numpy.outer(numpy.sin(longitude), near[:, 1])) + numpy.sin(lat) * near[:, 2]
        density[row] = numpy.exp((cosine - 1) / math.radians(2.5) ** 2).sum(axis=1)
    density = (density / density.mean()) ** 2
    x = (numpy.arange(WIDTH) + 0.5) / 8 - 0.5
    y = numpy.clip((numpy.arange(HEIGHT) + 0.5) / 8 - 0.5, 0, height - 1)
    x0, y0 = numpy.floor(x).astype(int), numpy.minimum(numpy.floor(y).astype(int), height - 2)
    in_rows = density[y0] * (1 - (y - y0))[:, None] + density[y0 + 1] * (y - y0)[:, None]
    smooth = in_rows[:, x0 % width] * (1 - (x - x0)) + in_rows[:, (x0 + 1) % width] * (x - x0)
    return 0.012 * smooth[:, :, None] * numpy.array([1.0, 0.93, 0.85])


def main():
    with open(FOLDER / "stars_hipparcos.csv", newline="") as file:
        lines = [line for line in file if not line.startswith("#")]
    stars = list(csv.DictReader(lines))
    sky = glow(stars)
    for star in stars:
        flux = 10 ** (-0.4 * (float(star["v_mag"]) - 4.0))
        draw(sky, float(star["ra_deg"]), float(star["dec_deg"]), flux * colour(float(star["b_minus_v"] or 0.6)))
    sky = numpy.clip(sky, 0, 1)
    encoded = numpy.where(sky <= 0.0031308, 12.92 * sky, 1.055 * sky ** (1 / 2.4) - 0.055)
    picture = FOLDER / "stars_sky.ppm"
    picture.write_bytes(b"P6 %d %d 255\n" % (WIDTH, HEIGHT) + (encoded * 255 + 0.5).astype("uint8").tobytes())
    subprocess.run(["oiiotool", str(picture), "--nosoftwareattrib", "--compression", "zip:9", "-o",
                    str(FOLDER / "stars_sky.png")], check=True)
    picture.unlink()


main()
