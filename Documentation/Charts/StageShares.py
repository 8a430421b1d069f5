#!/usr/bin/python3
"""Draws where the time of runs goes, a bar a run, a colour a stage, as SVG; and prints a table of the same.

    StageShares.py OUT.svg REPORT.json...

The reports are of `lambert solve --report`; a bar is named after its file.
"""
import json
import os
import sys

GROUPS = (  # name, colour, stages of the report
    ("reading", "#8c8c8c", ("load",)),
    ("clusters", "#c49c3b", ("cluster",)),
    ("rays, sides, elements", "#5b8c5a", ("rays", "lit sides", "elements")),
    ("links", "#2f6fa8", ("links", "exposure", "exchange")),
    ("gather at leaves", "#8856a7", ("gather at leaves",)),
    ("gather at points", "#c2504d", ("gather at points",)),
    ("cuts", "#e08e5b", ("cuts",)),
    ("verification", "#444444", ("verification",)),
    ("rest", "#bfbfbf", ("reconstruction", "energy balance", "reconstruct", "write")),
)
LEFT, WIDTH, BAR, GAP, TOP = 130, 620, 22, 10, 70  # Pixels


def seconds_of(name):
    """Of every group, from a report."""
    with open(name) as file:
        report = json.load(file)
    stages = {**report["seconds"], **report["seconds_of_solve"]}
    return [sum(stages.get(stage, 0) for stage in group) for _, _, group in GROUPS]


def text(x, y, words, anchor="start"):
    return f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}">{words}</text>'


def drawing(runs):
    """Bars of equal length, the seconds of each at its end."""
    height = TOP + len(runs) * (BAR + GAP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{LEFT + WIDTH + 80}" height="{height}" '
             'font-family="sans-serif" font-size="13">', f'<rect width="100%" height="{height}" fill="white"/>']
    for k, (name, colour, _) in enumerate(GROUPS):
        x, y = 20 + 165 * (k % 5), 14 + 24 * (k // 5)
        parts += [f'<rect x="{x}" y="{y}" width="14" height="14" fill="{colour}"/>', text(x + 20, y + 12, name)]
    for row, (name, seconds) in enumerate(runs):
        y, x = TOP + row * (BAR + GAP), LEFT
        parts.append(text(LEFT - 10, y + 16, name, "end"))
        for (_, colour, _), part in zip(GROUPS, seconds):
            width = WIDTH * part / sum(seconds)
            parts.append(f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="{BAR}" fill="{colour}"/>')
            x += width
        parts.append(text(LEFT + WIDTH + 8, y + 16, f"{sum(seconds):.1f} s"))
    return "\n".join(parts + ["</svg>", ""])


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    runs = [(os.path.splitext(os.path.basename(name))[0], seconds_of(name)) for name in sys.argv[2:]]
    with open(sys.argv[1], "w") as file:
        file.write(drawing(runs))
    print("| run | " + " | ".join(name for name, _, _ in GROUPS) + " | all, s |")
    print("|---" * (len(GROUPS) + 2) + "|")
    for name, seconds in runs:
        print(f"| {name} | " + " | ".join(f"{part:.2f}" for part in seconds) + f" | {sum(seconds):.1f} |")


if __name__ == "__main__":
    main()
