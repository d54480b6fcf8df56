#!/usr/bin/env python3
# Makes earth_night.png from earth_night.jpg: 16 bits, without the blocks of 8 x 8 pixels.
#
# The seas of the picture by NASA are a few codes of 8 bits bright, and JPEG keeps of them one flat tone for each
# block: three stops brighter that is seen. Where the picture is as even as such blocks are it is smoothed, over
# what is even alone, so that no coast and no town changes; the rest stays as it is. Needs numpy and oiiotool.
import pathlib
import subprocess

import numpy

FOLDER = pathlib.Path(__file__).parent
WIDTH, HEIGHT = 4096, 2048
BLOCK = 8
EVEN, UNEVEN = 5.0, 10.0  # codes between the darkest and the brightest pixel around: even up to here; not from there
REACH = 12  # pixels of the window that is smoothed over, on either side, three times


def shifted(image, by, axis):
    """The image moved along an axis: round the globe, and held at the poles."""
    if axis == 1:
        return numpy.roll(image, by, 1)
    rows = numpy.clip(numpy.arange(HEIGHT) - by, 0, HEIGHT - 1)
    return image[rows]


def extreme(image, pick, reach):
    """The largest or smallest value within a square."""
    for axis in (0, 1):
        result = image
        for by in range(1, reach + 1):
            result = pick(result, pick(shifted(image, by, axis), shifted(image, -by, axis)))
        image = result
    return image


def blurred(image):
    """Three means over squares, one after another."""
    for _ in range(3):
        for axis in (0, 1):
            total = image.copy()
            for by in range(1, REACH + 1):
                total += shifted(image, by, axis) + shifted(image, -by, axis)
            image = total / (2 * REACH + 1)
    return image


def main():
    raw = FOLDER / "earth_night.ppm"
    subprocess.run(["oiiotool", str(FOLDER / "earth_night.jpg"), "-o", str(raw)], check=True)
    codes = numpy.frombuffer(raw.read_bytes()[-3 * WIDTH * HEIGHT:], "uint8").reshape(HEIGHT, WIDTH, 3)
    raw.unlink()
    codes = codes.astype("float32")
    spread = numpy.zeros((HEIGHT, WIDTH), "float32")
    for c in range(3):
        spread = numpy.maximum(spread, extreme(codes[:, :, c], numpy.maximum, BLOCK) -
                               extreme(codes[:, :, c], numpy.minimum, BLOCK))
    evenness = numpy.clip((UNEVEN - spread) / (UNEVEN - EVEN), 0, 1)
    weight = blurred(evenness)
    for c in range(3):
        smooth = blurred(codes[:, :, c] * evenness) / numpy.maximum(weight, 1e-6)
        codes[:, :, c] += evenness * (smooth - codes[:, :, c])
    # Quarters of a code in what is smooth, which nobody sees four stops brighter; whole codes elsewhere: so the
    # file stays small.
    steps = numpy.where(evenness > 0, 4, 1)[:, :, None]
    codes = numpy.round(codes * steps) / steps
    picture = FOLDER / "earth_night.ppm"
    picture.write_bytes(b"P6 %d %d 65535\n" % (WIDTH, HEIGHT) + (codes * 257 + 0.5).astype(">u2").tobytes())
    subprocess.run(["oiiotool", str(picture), "--nosoftwareattrib", "--sattrib", "oiio:ColorSpace", "sRGB",
                    "--compression", "zip:9", "-o",
                    str(FOLDER / "earth_night.png")], check=True)
    picture.unlink()


main()
