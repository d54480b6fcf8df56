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
# The scenes, and of each the rows whose error maps are shown, with what their files are called.
SCENES = {
    "seed-fig5": {"shinotsuka-makino": "paper", "planes, law auto, 0.1 px, finite distance on": "auto"},
    "seed-fig6": {},
    "black-hole": {"planes, law exact, finite distance on": "exact", "geodesic, 0.01 px": "geodesic"},
    "wide-group": {"planes, law weak, finite distance on": "weak", "planes, law auto, 0.1 px, finite distance on": "auto"},
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
            seconds(row["seconds"]), *(f"{error[key]:.2g}" for key in ("median_px", "p99_px", "most_px")),
            f"{100 * error['share_above_0.1_px']:.1f} %", f"{100 * error['share_validity_differs']:.1f} %",
            "no limit" if bound is None else bound if bound == "-" else f"{bound:.2g}",
            f"{row['left_out_px']:.2g}" if "left_out_px" in row else "-"])
    return table(rows, ["trace", "a frame", "median, px", "99 %, px", "most, px", "> 0.1 px", "validity", "bound, px", "left out, px"])


def pictures(study):
    rows = [[f"up to {r['max']}", f"{r['threshold']:g}", f"{r['settings']['tolerance_px']:g} px",
             seconds(r["time"]["median_s"]), f"{r['rays_per_pixel']:.3g}", f"{r['psnr_db']:.1f} dB"]
            for r in study["pictures"]]
    return table(rows, ["rays", "threshold", "tolerance", "a frame", "rays a pixel", "PSNR"])


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/lensplane")
    images = ROOT / "docs/images"
    with tempfile.TemporaryDirectory() as folder:
        for scene, mapped in SCENES.items():
            subprocess.run([program, "study", str(ROOT / "scenes" / (scene + ".yaml")), "-f", "1001", "--output", folder,
                            "--quiet"], check=True)
            written = pathlib.Path(folder) / (scene + ".study.1001")
            html = (written / "study.html").read_text()
            (images / f"accuracy-{scene}.svg").write_text(re.search(r'<svg id="plot".*?</svg>', html, re.S).group(0) + "\n")
            for name, data in re.findall(r'alt="errors of ([^"]*)" src="data:image/png;base64,([^"]*)"', html):
                if name in mapped:
                    (images / f"accuracy-{scene}-{mapped[name]}.png").write_bytes(base64.b64decode(data))
            study = json.loads((written / "study.json").read_text())
            print(f"\n## {scene}\n\n{study['advice']}\n\n{traces(study)}\n\n{pictures(study)}")


main()
