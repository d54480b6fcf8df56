#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws images/speed-by-sources.svg and images/speed-by-pixels.svg from what trace_benchmark has written:

    build/dev/bin/trace_benchmark --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
        --benchmark_out=speed.json
    docs/plot-speed.py speed.json
"""
import json
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).parent / "images"
WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 720, 420, 80, 60, 30, 20
# Nanoseconds that the instructions of one weak bend of one ray take, see performance.md.
FLOOR_NS = 1.4


def medians(path):
    """Name to (seconds of one run, items per second)."""
    runs = json.load(open(path))["benchmarks"]
    return {r["run_name"]: (r["real_time"] / 1e3, r["items_per_second"])
            for r in runs if r.get("aggregate_name") == "median"}


class Chart:
    """Points and lines on two logarithmic axes."""

    def __init__(self, title, x_title, y_title, x_range, y_range):
        self.x_range, self.y_range = x_range, y_range
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
            f'font-size="13"><rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
            f'<text x="{WIDTH / 2}" y="20" text-anchor="middle" font-size="15">{title}</text>',
            f'<text x="{WIDTH / 2}" y="{HEIGHT - 12}" text-anchor="middle">{x_title}</text>',
            f'<text x="18" y="{HEIGHT / 2}" text-anchor="middle" transform="rotate(-90 18 {HEIGHT / 2})">'
            f'{y_title}</text>']
        for power in range(math.ceil(math.log10(x_range[0])), math.floor(math.log10(x_range[1])) + 1):
            x = self.x(10**power)
            self.line(x, TOP, x, HEIGHT - BOTTOM, "#ddd")
            self.text(x, HEIGHT - BOTTOM + 18, f"{10**power:g}", "middle")
        for power in range(math.ceil(math.log10(y_range[0])), math.floor(math.log10(y_range[1])) + 1):
            y = self.y(10**power)
            self.line(LEFT, y, WIDTH - RIGHT, y, "#ddd")
            self.text(LEFT - 8, y + 4, f"{10**power:g}", "end")

    def x(self, value):
        low, high = map(math.log10, self.x_range)
        return LEFT + (math.log10(value) - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        low, high = map(math.log10, self.y_range)
        return HEIGHT - BOTTOM - (math.log10(value) - low) / (high - low) * (HEIGHT - BOTTOM - TOP)

    def line(self, x0, y0, x1, y1, colour):
        self.parts.append(f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{colour}"/>')

    def text(self, x, y, text, anchor, colour="#333"):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{text}</text>')

    def series(self, points, colour, label, dots=True):
        path = " ".join(f"{self.x(x):.1f},{self.y(y):.1f}" for x, y in points)
        dash = "" if dots else ' stroke-dasharray="6 4"'
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>')
        for x, y in points if dots else []:
            self.parts.append(f'<circle cx="{self.x(x):.1f}" cy="{self.y(y):.1f}" r="4" fill="{colour}"/>')
        x, y = points[len(points) // 2]
        self.text(self.x(x) + (-10 if dots else 10), self.y(y) + (-10 if dots else 22), label,
                  "end" if dots else "start", colour)

    def save(self, name):
        (FOLDER / name).write_text("\n".join(self.parts) + "\n</svg>\n")


def main():
    runs = medians(sys.argv[1])
    of = lambda name: sorted((int(key.split("/")[1]), value) for key, value in runs.items()
                             if key.startswith(name + "/") and (name != "map_of_width" or key.split("/")[2] == "1"))
    rates = [(count, 1e9 / rate) for count, (_, rate) in of("sources_on_ten_planes")]
    chart = Chart("One ray past sources on ten planes, weak law, one core", "sources", "nanoseconds a ray",
                  (0.8, 13000), (1, 30000))
    chart.series(rates, "#1667b1", "measured")
    chart.series([(count, FLOOR_NS * count) for count, _ in rates], "#b13a16", "the floor", dots=False)
    chart.save("speed-by-sources.svg")
    maps = [(width * width * 9 / 16 / 1e6, seconds) for width, (seconds, _) in of("map_of_width")]
    chart = Chart("A map of three sources, weak law, one core", "million pixels", "seconds", (0.05, 200), (0.001, 10))
    chart.series(maps, "#1667b1", "measured")
    floor = [(pixels, pixels / (runs["bare_loop"][1] / 1e6)) for pixels, _ in maps]
    chart.series(floor, "#b13a16", "tracing by hand, nothing stored", dots=False)
    chart.save("speed-by-pixels.svg")


main()
