#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Studies the scenes of docs/accuracy.md once more: plots and error maps into docs/images, tables to standard output.

Usage: docs/accuracy.py [PROGRAM], which is build/release/bin/lensplane if it is not given.
"""

import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ["seed-fig5", "seed-fig6", "black-hole", "wide-group"]
MAPPED = {  # the rows whose error maps are shown, and what their files are called
    "shinotsuka-makino": "paper",
    "planes, law weak, finite distance on": "weak",
    "planes, law auto, 0.1 px, finite distance on": "auto",
}


def table(rows, head):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def seconds(s):
    return f"{s * 1e3:.3g} ms" if s < 1 else f"{s:.3g} s"


def traces(study):
    rows = []
    for row in study["traces"]:
        error, bound = row["error"], row.get("bound_px", "-")
        rows.append([
            ("**" if row["pareto"] else "") + row["name"] + ("**" if row["pareto"] else ""),
            seconds(row["seconds"]), f"{error['median_px']:.2g}", f"{error['p99_px']:.2g}", f"{error['most_px']:.2g}",
            f"{100 * error['share_above_0.1_px']:.1f} %",
            "no limit" if bound is None else bound if bound == "-" else f"{bound:.2g}",
            f"{row['left_out_px']:.2g}" if "left_out_px" in row else "-"])
    return table(rows, ["trace", "a frame", "median, px", "99 %, px", "most, px", "> 0.1 px", "bound, px", "left out, px"])


def pictures(study):
    rows = [[f"up to {r['max']}", f"{r['threshold']:g}", f"{r['settings']['tolerance_px']:g} px",
             seconds(r["time"]["median_s"]), f"{r['rays_per_pixel']:.3g}", f"{r['psnr_db']:.1f} dB"]
            for r in study["pictures"]]
    return table(rows, ["rays", "threshold", "tolerance", "a frame", "rays a pixel", "PSNR"])


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/lensplane")
    images = ROOT / "docs/images"
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            subprocess.run([program, "study", str(ROOT / "scenes" / (scene + ".yaml")), "-f", "1001", "--output", folder,
                            "--quiet"], check=True)
            written = pathlib.Path(folder) / (scene + ".study.1001")
            html = (written / "study.html").read_text()
            (images / f"accuracy-{scene}.svg").write_text(re.search(r'<svg id="plot".*?</svg>', html, re.S).group(0) + "\n")
            for name, data in re.findall(r'alt="errors of ([^"]*)" src="data:image/png;base64,([^"]*)"', html):
                if name in MAPPED:
                    (images / f"accuracy-{scene}-{MAPPED[name]}.png").write_bytes(base64.b64decode(data))
            study = json.loads((written / "study.json").read_text())
            print(f"\n## {scene}\n\n{study['advice']}\n\n{traces(study)}\n\n{pictures(study)}")


main()
