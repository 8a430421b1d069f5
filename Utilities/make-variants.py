#!/usr/bin/python3
"""Writes copies of an OBJ as real CAD exports spoil them: the light of each must be the same.

    make-variants.py SCENE.obj OUTPUT-FOLDER [--seed N]

writes into OUTPUT-FOLDER
    NAME-inverted.obj  every face wound the other way,
    NAME-doubled.obj   every face twice, the second time wound the other way,
    NAME-mixed.obj     a random half of the faces wound the other way (by --seed, default 1),
and leaves faces of emitting materials (a Ke above 0 in the scene's MTL) as they are: an emitter shines from its front, so
winding it the other way is another scene. The copies share one MTL, NAME-variants.mtl, which names its textures by absolute paths.
"""
import argparse
import pathlib
import random
import re
import sys


def material_libraries(obj_lines, folder):
    """The MTL files that the scene names. A name may hold blanks."""
    for line in obj_lines:
        if line.startswith("mtllib"):
            name = line[len("mtllib"):].strip()
            whole = folder / name
            yield from [whole] if whole.is_file() else [folder / part for part in name.split()]


def emitting_materials(libraries):
    """Names of the materials whose Ke is above 0 in some band."""
    emitting, name = set(), None
    for library in libraries:
        for line in library.read_text(errors="surrogateescape").splitlines():
            words = line.split()
            if words[:1] == ["newmtl"]:
                name = line.strip()[len("newmtl"):].strip()
            elif words[:1] == ["Ke"] and any(float(value) > 0 for value in words[1:4]):
                emitting.add(name)
            elif words[:1] in (["map_Ke"], ["map_emissive"]):
                emitting.add(name)
    return emitting


def absolute_mtl(library):
    """Text of an MTL whose texture files are named by absolute paths."""
    def absolute(match):
        texture = library.parent / match[3].replace("\\", "/")
        return f"{match[1]}{match[2]}{texture.resolve()}" if texture.is_file() else match[0]

    # The file name is the last word, or all that follows where no option stands before it.
    pattern = re.compile(r"^(\s*(?:map_\w+|bump|disp|norm|refl)\s+)((?:-\S+\s+(?:[-\d.]+\s+|on\s+|off\s+)*)*)(.+?)\s*$", re.M)
    return pattern.sub(absolute, library.read_text(errors="surrogateescape"))


def reversed_face(line):
    """The face wound the other way, its first corner kept. Corners carry their uvs and normals with them."""
    words = line.split()
    return " ".join([words[0], words[1]] + words[:1:-1])


def spoil(lines, emitting, change):
    """The scene with each face of a material that does not emit replaced by change(face)."""
    material = None
    for line in lines:
        words = line.split()
        if words[:1] == ["usemtl"]:
            material = line.strip()[len("usemtl"):].strip()
        if words[:1] == ["f"] and len(words) > 3 and material not in emitting:
            yield from change(line)
        else:
            yield line


def logical_lines(text):
    """Lines with those that end in a backslash joined."""
    return re.sub(r"\\\r?\n", " ", text).splitlines()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1, help="of the mixed copy; default 1")
    arguments = parser.parse_args()
    if not arguments.scene.is_file():
        sys.exit(f"make-variants.py: {arguments.scene} is no file.")

    # The scene, and what of it emits.
    folder, name = arguments.scene.resolve().parent, arguments.scene.stem
    lines = logical_lines(arguments.scene.read_text(errors="surrogateescape"))
    libraries = [library for library in material_libraries(lines, folder) if library.is_file()]
    emitting = emitting_materials(libraries)

    # One MTL for all copies.
    arguments.output.mkdir(parents=True, exist_ok=True)
    mtl = "\n".join(absolute_mtl(library) for library in libraries)
    (arguments.output / f"{name}-variants.mtl").write_text(mtl, errors="surrogateescape")
    lines = [f"mtllib {name}-variants.mtl"] + [line for line in lines if not line.startswith("mtllib")]

    # The copies.
    coin = random.Random(arguments.seed)
    changes = {
        "inverted": lambda face: [reversed_face(face)],
        "doubled": lambda face: [face, reversed_face(face)],
        "mixed": lambda face: [reversed_face(face) if coin.random() < 0.5 else face],
    }
    for variant, change in changes.items():
        path = arguments.output / f"{name}-{variant}.obj"
        path.write_text("\n".join(spoil(lines, emitting, change)) + "\n", errors="surrogateescape")
        print(path)


if __name__ == "__main__":
    main()
