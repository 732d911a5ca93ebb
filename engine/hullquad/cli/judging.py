"""The command quality: a mesh judged by every metric."""

import csv
import io
import sys
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hullquad.cli.clock import Clock
from hullquad.cli.loading import load
from hullquad.cli.output import say, say_json
from hullquad.cli.report import mesh_figures, metric_figures
from hullquad.formats import atomic, read_mesh
from hullquad.mesh import Mesh
from hullquad.metrics import METRICS
from hullquad.quality import Quality, quality


def judge_mesh(options: Namespace) -> bool:
    """Judge a mesh; never refuses a part of it."""
    mesh = read_mesh(options.input)
    clock = Clock("import", "prepare", "judge")
    load(clock)
    with clock.running("judge"):
        judged = {row.key: quality(mesh, row) for row in METRICS}
    if options.csv == "-":
        sys.stdout.writelines(_rows(mesh, judged))
    elif options.csv:
        atomic.write(Path(options.csv), (row.encode() for row in _rows(mesh, judged)))
    if options.json:
        figures = mesh_figures(mesh, judged["stretch"])
        metrics = {key: metric_figures(mesh, by_key) for key, by_key in judged.items()}
        say_json({**figures, "metrics": metrics, "seconds": clock.taken()})
    elif options.csv != "-":
        say(_summary(mesh, judged))
    return False


def _summary(mesh: Mesh, judged: dict[str, Quality]) -> str:
    """Table of all metrics: worst, mean, failing."""
    figures = mesh_figures(mesh, judged["stretch"])
    numbers = (f"{figures[name]} {name}" for name in ("quads", "triangles", "nodes", "inverted", "reversed"))
    lines = [
        ", ".join(numbers),
        "",
        f"{'metric':<22}{'acceptable':>14}{'worst':>12}{'at element':>12}{'mean':>12}{'failing':>9}",
    ]
    for row in METRICS:
        by_row = metric_figures(mesh, judged[row.key])
        title = f"{row.title} [{row.unit}]" if row.unit else row.title
        band = f"{row.quads.acceptable[0]:g} to {row.quads.acceptable[1]:g}"
        lines.append(
            f"{title:<22}{band:>14}{by_row['worst']:>12.3f}{by_row['worst_element']:>12}"
            f"{by_row['mean']:>12.3f}{by_row['failing']:>9}"
        )
    if figures["triangles"]:
        by_shape = " and ".join(row.title.lower() for row in METRICS if row.triangles is None)
        lines += ["", f"Triangles are judged by their own bands; under {by_shape} by their shape."]
    return "\n".join(lines)


def _rows(mesh: Mesh, judged: dict[str, Quality]) -> Iterator[str]:
    """Lines of the CSV, a heading and one for each element; empty where a triangle has no such metric."""
    lines = io.StringIO()
    writer = csv.writer(lines, lineterminator="\n")
    writer.writerow(["element", "type", "valid", *judged])
    topology = mesh.topology
    kinds = np.where(topology.is_triangle, "triangle", "quad").tolist()
    valid = np.where(judged["stretch"].valid, "true", "false").tolist()
    columns = [_column(mesh, by_key) for by_key in judged.values()]
    for row in zip(topology.element_labels.tolist(), kinds, valid, *columns, strict=True):
        writer.writerow(row)
        if lines.tell() > 1 << 20:
            yield lines.getvalue()
            lines.seek(0)
            lines.truncate()
    yield lines.getvalue()


def _column(mesh: Mesh, by_key: Quality) -> list[str]:
    undefined = mesh.topology.is_triangle & (by_key.metric.triangles is None)
    return [
        "" if empty else repr(value) for empty, value in zip(undefined.tolist(), by_key.values.tolist(), strict=True)
    ]
