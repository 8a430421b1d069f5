#!/usr/bin/python3
"""Lights the engine of Debian's package assimp-testmodels in a studio, as a light-mapped GLB and a page, and shoots the page.

    LightMappedEngine.py FOLDER [--shot OUT.png] [--page-size N] [--error E] [--model FILE]

FOLDER gets engine.glb, engine.html and what lambert tells of them, engine.json; the figures are printed. `lambert` and
`chromium` have to be on the PATH.
"""
import argparse
import base64
import json
import os
import re
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "Testing", "Python"))
from Browser import Browser  # noqa: E402

MODEL = "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"
SIZE = 1000, 700  # Pixels of the picture


def box_of(model):
    """Lowest and highest corner, m, as lambert reads it."""
    told = subprocess.run(["lambert", "info", model, "--unit", "mm", "--json"], check=True, capture_output=True, text=True)
    scene = json.loads(told.stdout)["scene"]
    return np.array(scene["bounds_low_m"]), np.array(scene["bounds_high_m"])


def write_studio(name, low, high):
    """A white backdrop below and behind, and a square lamp above and before the model. Radiance, W/(m2 sr)."""
    size = np.linalg.norm(high - low)
    middle = (low + high) / 2
    floor, back = low[1], low[2] - 0.5 * size
    left, right = middle[0] - 1.7 * size, middle[0] + 0.9 * size
    front, top = high[2] + 0.5 * size, low[1] + 0.8 * size
    lamp = middle + size * np.array([-0.6, 0.9, 0.5])
    a, b = 0.25 * size * np.array([[1, 0, 0], [0, 0.45, -0.89]])
    with open(name.replace(".obj", ".mtl"), "w") as file:
        file.write("newmtl Backdrop\nKd .35 .35 .36\nnewmtl Lamp\nKd 0 0 0\nKe 40 38 34\n")
    corners = [(left, floor, front), (right, floor, front), (right, floor, back), (left, floor, back), (left, top, back),
               (right, top, back), lamp - a - b, lamp - a + b, lamp + a + b, lamp + a - b]
    with open(name, "w") as file:
        file.write(f"mtllib {os.path.basename(name)[:-4]}.mtl\n")
        file.writelines("v {:.9g} {:.9g} {:.9g}\n".format(*1000 * np.array(corner)) for corner in corners)
        file.write("usemtl Backdrop\nf 1 2 3 4\nf 4 3 6 5\nusemtl Lamp\nf 7 8 9 10\n")


def solve(folder, arguments, studio, camera):
    """Makes the page, and takes out the GLB that it carries. Returns the report."""
    report, page = os.path.join(folder, "engine.json"), os.path.join(folder, "engine.html")
    subprocess.run(["lambert", "solve", arguments.model, studio, "--unit", "mm", "--error", str(arguments.error),
                    "--sky", "0.25", "0.3", "0.35", "--exposure", "-1.7", "--camera", camera, "--padding", "4",
                    "--lightmap", os.path.join(folder, "engine.vtp"), "--page-size", str(arguments.page_size),
                    "--report", report, "-o", page, "--progress", "none"], check=True, stdout=subprocess.DEVNULL)
    with open(page) as file:
        model = re.search(r'id="model"[^>]*>([^<]*)<', file.read()).group(1)
    with open(os.path.join(folder, "engine.glb"), "wb") as file:
        file.write(base64.b64decode(model))
    return json.load(open(report))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--shot")
    parser.add_argument("--page-size", type=int, default=2048)
    parser.add_argument("--error", type=float, default=0.05)
    parser.add_argument("--model", default=MODEL)
    arguments = parser.parse_args()
    if not os.path.exists(arguments.model):
        sys.exit(f"There is no {arguments.model}: apt-get install assimp-testmodels, or name another by --model.")
    os.makedirs(arguments.folder, exist_ok=True)

    # The model in its studio, seen from before and above.
    low, high = box_of(arguments.model)
    studio = os.path.join(arguments.folder, "studio.obj")
    write_studio(studio, low, high)
    size = np.linalg.norm(high - low)
    at = (low + high) / 2
    eye = at + size * np.array([0.42, 0.45, 1.15])
    camera = ",".join(f"{x:.6g}" for x in (*eye, *at, 34))
    told = solve(arguments.folder, arguments, studio, camera)

    # What came out.
    light_map, mega = told["light_map"], os.path.getsize(os.path.join(arguments.folder, "engine.glb")) / 1e6
    print(f"{told['scene']['triangles']} triangles, {light_map['charts']} charts on {light_map['pages']} page(s), "
          f"{100 * light_map['utilisation']:.0f} % used; seams {100 * light_map['seams_before']['rms']:.2g} % before, "
          f"{100 * light_map['seams_after']['rms']:.2g} % after; {told['seconds']['total']:.1f} s; GLB {mega:.1f} MB")
    if arguments.shot:
        with Browser(*SIZE) as browser:
            browser.show(os.path.abspath(os.path.join(arguments.folder, "engine.html")), "#bare")
            browser.shoot(arguments.shot)


if __name__ == "__main__":
    main()
