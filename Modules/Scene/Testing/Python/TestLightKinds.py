"""No method knows kinds of lights: a new one is a file in Scene and a maker in the table of LightSource.cxx."""
import os
import re

modules = os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Modules")
KINDS = re.compile(r"LightType::|\bIsPlaced\(|\bConeFactor\(|Make(Lamp|Sun|Sky|GradientSky|Environment)\b")


def naming_kinds(folder):
    """The files under `folder`, tests apart, that name a kind."""
    found = []
    for path, _, files in os.walk(folder):
        for name in files:
            if not name.endswith((".h", ".cxx")) or "Testing" in path.split(os.sep):
                continue
            with open(os.path.join(path, name), encoding="utf-8") as file:
                if KINDS.search(file.read()):
                    found.append(name)
    return sorted(found)


# Methods, and what stands between them and the scene.
for module in ("Clustering", "Visibility", "Radiosity", "Classical", "Reference", "Display", "Atlas"):
    assert not naming_kinds(os.path.join(modules, module)), (module, naming_kinds(os.path.join(modules, module)))

# Where kinds are made: each by one file, all of them by one table. It is what the search would find elsewhere.
core = naming_kinds(os.path.join(modules, "Scene", "Core"))
assert "LightSource.cxx" in core and "GradientSky.cxx" in core, core
with open(os.path.join(modules, "Scene", "Core", "LightSource.cxx"), encoding="utf-8") as file:
    makers = set(re.findall(r"Make\w+", re.search(r"kMakers\[\].*?\{(.*?)\}", file.read(), re.S).group(1)))
assert len(makers) >= 5, makers
for maker in makers:
    defining = [name for name in core if name.endswith(".cxx") and name != "LightSource.cxx"
                and re.search(rf"LightSource> {maker}\(", open(os.path.join(modules, "Scene", "Core", name), encoding="utf-8").read())]
    assert len(defining) == 1, (maker, defining)
