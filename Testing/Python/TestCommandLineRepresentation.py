"""`lambert solve -o OUT.{glb,obj,html} --represent ... --introduced N`: surfaces lit at their points beside others in the light map."""
import numpy as np
from Browser import Browser
from CommandLine import DATA, solve, temporary, write_png
from GltfModel import GltfModel, encoded, insist_on_valid

import lambert

# A floor of 2 m in two halves that meet at x = 1, of two materials that are alike, the right one wound downwards; a wall; a lamp.
def scene_of(name, floor):
    """Both of its halves are of `floor`, lines of MTL."""
    with open(temporary(name + ".mtl"), "w") as file:
        file.write(f"newmtl left\n{floor}newmtl right\n{floor}newmtl wall\nKd .6 .6 .6\nnewmtl lamp\nKd 0 0 0\nKe 30 30 30\n")
    scene = temporary(name + ".obj")
    with open(scene, "w") as file:
        file.write(f"mtllib {name}.mtl\nv 0 0 0\nv 0 0 2\nv 1 0 2\nv 1 0 0\nv 2 0 2\nv 2 0 0\nv 0 2 0\nv 2 2 0\n"
                   "v .7 1.9 .7\nv 1.3 1.9 .7\nv 1.3 1.9 1.3\nv .7 1.9 1.3\nvt .25 0\nvt .25 2\nvt 1.25 2\nvt 1.25 0\nvt 2.25 2\nvt 2.25 0\n"
                   "usemtl left\nf 1/1 2/2 3/3 4/4\nusemtl right\nf 6/6 5/5 3/3 4/4\nusemtl wall\nf 1 6 8 7\nusemtl lamp\nf 9 10 11 12\n")
    return scene, "--error", "0.03", "--no-orient", "--camera", "1,1.6,3.6,1,0.3,0.5,40"


halves = scene_of("halves", "Kd .7 .6 .5\n")
light_map = "--lightmap", temporary("map.vtp"), "--page-size", "256"
chosen = *light_map, "--represent", "left:points"
written = []


def model_of(name, *arguments):
    """A model as GLB, and the report."""
    written.append(temporary(name))
    report = solve(*arguments, "-o", written[-1])
    return GltfModel(written[-1]), report


def by_kind(model):
    """The primitives under a light map, and those lit at their points."""
    primitives = list(model.primitives())
    for attributes, _, material in primitives:
        is_mapped = material["name"].startswith("light map")
        assert ("TEXCOORD_0" in attributes) == ("baseColorTexture" in material["pbrMetallicRoughness"])
        assert is_mapped == ("COLOR_0" not in attributes) and "KHR_materials_unlit" in material["extensions"]
    return [[p for p in primitives if ("COLOR_0" in p[0]) == is_lit_at_points] for is_lit_at_points in (False, True)]


def area(primitives):
    corners = np.concatenate([attributes["POSITION"][triangles] for attributes, triangles, _ in primitives])
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2


def steps(model, mapped, at_points, places):
    """Codes by which the kinds differ where they meet."""
    return encoded(model.shown(at_points, places)) - encoded(model.shown(mapped, places))


# One half at its points, all else on a page; every lit side once.
points, _ = model_of("points.glb", *halves)
mixed, report = model_of("mixed.glb", *halves, *chosen)
(page,), (left,) = by_kind(mixed)
assert {s["material"]: s["chosen"] for s in report["representation"]["surfaces"]} == {
    "left": "points", "right": "lightmap", "wall": "lightmap", "lamp": "lightmap"}
assert len(mixed.document["images"]) == 1 and len(page[1]) == 6
assert abs(area([page, left]) / area(points.primitives()) - 1) < 1e-5
assert left[0]["POSITION"][:, 0].max() == 1 and not left[0]["POSITION"][:, 1].any()
assert {s["material"]: s["side"] for s in report["representation"]["surfaces"]}["right"] == "back"
corners = page[0]["POSITION"][page[1]]
on_floor = (corners[:, :, 1] == 0).all(axis=1)
assert on_floor.sum() == 2
assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[on_floor, 1] > 0).all()  # Seen from above

# What lies at its points shows what it shows without a map: one exposure, one curve.
whole, = points.primitives()
places = np.column_stack([np.linspace(0.1, 0.9, 40), np.zeros(40), np.linspace(0.2, 1.8, 40)])
assert np.allclose(mixed.shown(left, places), points.shown(whole, places), atol=1e-4)

# Where the halves meet nothing is to be seen: texels of 12 mm between points a few centimetres apart, in codes of 8 bits.
border = np.column_stack([np.ones(200), np.zeros(200), np.linspace(0.02, 1.98, 200)])
assert np.ptp(encoded(mixed.shown(left, border))) > 30  # Of light that changes.
assert np.abs(steps(mixed, page, left, border)).max() < 1.5, np.abs(steps(mixed, page, left, border)).max()

# Any surface as wanted, whatever its material; a budget that holds all leaves the model of points as it is.
number, = [s["surface"] for s in report["representation"]["surfaces"] if s["material"] == "left"]
turned, _ = model_of("turned.glb", *halves, *chosen, "--represent", f"surface={number}:lightmap")
(page_of_turned,), others = by_kind(turned)
assert len(page_of_turned[1]) == 8 and not others
model_of("budget.glb", *halves, *light_map, "--introduced", "1000000")
assert open(written[-1], "rb").read() == open(written[0], "rb").read()
simple, _ = model_of("simple.glb", *halves, *chosen, "--simplify", "0.05")
(_,), (simple_left,) = by_kind(simple)
assert len(simple_left[1]) < len(left[1]) and abs(area([simple_left]) - 2) < 1e-5

# Within a surface: what refinement left alone is lit at its points, and the map says there what they say.
rooms = f"{DATA}/TwoRooms/TwoRooms.obj", "--error", "0.1"
of_points, _ = model_of("rooms.glb", *rooms)
cut, _ = model_of("cut.glb", *rooms, *light_map[:3], "512", "--introduced", "200", "--split-surfaces")
(page_of_cut,), (uncut,) = by_kind(cut)
assert abs(area([page_of_cut, uncut]) / area(of_points.primitives()) - 1) < 1e-5
at = uncut[0]["POSITION"]
floor = np.unique(at[(at[:, 1] == 0) & (np.abs(at[:, 0] - 2.5) > 0.1) & (at > (0.1, -1, 0.1)).all(axis=1) & (at < (4.9, 1, 2.9)).all(axis=1)], axis=0)
floor = floor[~np.isnan(cut.shown(page_of_cut, floor)[:, 0])]
step = steps(cut, page_of_cut, uncut, floor)
assert len(floor) > 30 and np.sqrt((step ** 2).mean()) < 0.3 and np.abs(step).max() < 1, (len(floor), np.abs(step).max())

# Under a texture, checks of half a metre: image and light at the points, both in one on the page. A curve that bends in
# what is shown bends both alike; toned by the texel the page would be 4 codes off.
is_dark = np.add.outer(np.arange(64) // 32, np.arange(64) // 32) % 2
checks = write_png(temporary("checks.png"), np.where(is_dark, 90, 230)[..., None].repeat(3, 2))
checked = *scene_of("checked", "Kd .7 .6 .5\nmap_Kd checks.png\n"), "--white", "10", "--exposure", "-1"
textured, report = model_of("checked.glb", *checked, *chosen)
(page_of_checks,), (left_checks,) = by_kind(textured)
assert left_checks[2]["name"] == "left" and textured.image(left_checks[2])[0] == open(checks, "rb").read()
assert report["lit_model"]["baked_texels"] > 0 and report["lit_model"]["clipped_points"] == 0
within = border[np.abs(border[:, 2] % 0.5 - 0.25) < 0.2]  # Edges of checks are as soft as a texel.
across = steps(textured, page_of_checks, left_checks, within)
assert np.ptp(encoded(textured.shown(left_checks, within))) > 50
assert np.abs(across).max() < 1.5, np.abs(across).max()
kept, _ = model_of("kept.glb", *checked, *chosen, "--keep-textures")
assert len(by_kind(kept)[1]) == 2 and {p[2]["name"] for p in by_kind(kept)[1]} == {"left", "right"}

# Under a dark one light at the points would have to be above 1: the image is brightened, as far as its brightest texel allows.
dark_image = write_png(temporary("dark.png"), np.where(is_dark, 20, 90)[..., None].repeat(3, 2))
dark = *scene_of("darkened", "Kd .7 .6 .5\nmap_Kd dark.png\n"), "--white", "10", "--exposure", "1"
darkened, report = model_of("darkened.glb", *dark, *chosen)
(page_of_dark,), (left_dark,) = by_kind(darkened)
assert darkened.image(left_dark[2])[0] != open(dark_image, "rb").read()
assert report["lit_model"]["clipped_points"] == 0
across = steps(darkened, page_of_dark, left_dark, within)
assert np.ptp(encoded(darkened.shown(left_dark, within))) > 50
assert np.abs(across).max() < 1.5, np.abs(across).max()

insist_on_valid(*written)

# As OBJ: the faces of either, the page, and the colours of points behind their positions.
obj = temporary("halves mixed.obj")
solve(*halves[:-2], *chosen, "-o", obj)  # Which no camera looks at.
lines = [line.split() for line in open(obj)]
points_of_obj = np.array([line[1:] for line in lines if line[0] == "v"], float)
corners = [[corner.split("/") for corner in line[1:]] for line in lines if line[0] == "f"]
assert [len(face[0]) for face in corners] == [2] * len(page[1]) + [1] * len(left[1])
faces = np.array([[int(corner[0]) - 1 for corner in face] for face in corners])
assert np.array_equal(points_of_obj[faces[len(page[1]):], :3].astype(np.float32), left[0]["POSITION"][left[1]])
assert np.abs(255 * points_of_obj[faces[len(page[1]):], 3:] - encoded(left[0]["COLOR_0"][left[1]][:, :, :3])).max() < 0.1
assert open(obj.replace(".obj", "-0.png"), "rb").read() == mixed.image(page[2])[0]

# A browser shows one picture, whatever shows the light.
if lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    shots = {}
    with Browser(480, 360) as browser:
        for name, options in (("points", ()), ("map", light_map), ("mixed", chosen)):
            html = temporary(name + ".html")
            solve(*halves, *options, "-o", html)
            browser.show(html, "#bare")
            shots[name] = browser.shoot(temporary(name + ".png"))
    difference = np.abs(shots["mixed"] - shots["points"]).max(axis=2)
    # Contact lines are as soft as a texel of the map.
    assert difference.mean() < 0.5 and np.percentile(difference, 99) < 4, (difference.mean(), np.percentile(difference, 99))
    assert np.abs(shots["mixed"] - shots["map"])[:, 245:].max() < 4  # The right half
