"""What is told of a mesh and of a run: the same figures for people and for programs."""

from typing import Any

from hullquad.mesh import Mesh
from hullquad.metrics import Metric
from hullquad.optimization.iterate import Outcome
from hullquad.quality import Quality
from hullquad.sentences import counted
from hullquad.topology import reversed_elements


def run_figures(run: Outcome) -> dict[str, Any]:
    """Figures of a run as they stand in the output of ``--json``."""
    before, after, last = run.first, run.best, run.last
    return {
        **mesh_figures(after.mesh, after.quality),
        "metric": after.quality.metric.key,
        "objective_before": before.objective,
        "objective_after": after.objective,
        "worst_before": before.quality.worst,
        "worst_after": after.quality.worst,
        "failing_before": before.quality.failing_count,
        "failing_after": after.quality.failing_count,
        "iterations": last.number,
        "stop": None if last.stop is None else last.stop.name,
    }


def mesh_figures(mesh: Mesh, quality: Quality) -> dict[str, Any]:
    """Numbers of elements and nodes, and of those that are not valid."""
    topology = mesh.topology
    return {
        "plate": mesh.plate_id,
        "quads": len(topology.quads),
        "triangles": len(topology.triangles),
        "triangles_unavoidable": None if mesh.is_bare else mesh.triangles_unavoidable,
        "nodes": len(mesh.points),
        "free": int(topology.is_free.sum()),
        "inverted": quality.inverted_count,
        "reversed": int(reversed_elements(topology.elements).sum()) if mesh.surface is None else 0,
    }


def run_text(run: Outcome) -> str:
    """What happened in a run, for people."""
    figures, metric = run_figures(run), run.best.quality.metric
    lines = [_elements_text(figures)]
    if run.last.number:
        lines += [_change_text(figures, metric), *_stop_text(run)]
    elif run.last.stop is not None:
        lines += _stop_text(run)
    else:
        lines.append(
            f"  sum of {metric.title.lower()} {figures['objective_after']:.4f}, "
            f"worst {figures['worst_after']:.3f}, failing {figures['failing_after']}"
        )
    if figures["inverted"]:
        lines.append(f"  inverted elements: {figures['inverted']}")
    return "\n".join(lines)


def _elements_text(figures: dict[str, Any]) -> str:
    unavoidable = figures["triangles_unavoidable"]
    note = "" if unavoidable is None else f" ({unavoidable} unavoidable)"
    return (
        f"{figures['plate'] or 'mesh'}: {counted(figures['quads'], 'quad')}, "
        f"{counted(figures['triangles'], 'triangle')}{note}, "
        f"{counted(figures['nodes'], 'node')}, {figures['free']} of them free"
    )


def _change_text(figures: dict[str, Any], metric: Metric) -> str:
    text = (
        f"  sum of {metric.title.lower()} {figures['objective_before']:.4f} -> {figures['objective_after']:.4f}, "
        f"worst {figures['worst_before']:.3f} -> {figures['worst_after']:.3f}, "
        f"failing {figures['failing_before']} -> {figures['failing_after']}"
    )
    if metric.is_worse(figures["worst_after"], figures["worst_before"]):
        text += "\n  note: the sum is better, but the worst element is worse than before"
    return text


def _stop_text(run: Outcome) -> list[str]:
    stop = run.last.stop
    if stop is None:
        return []
    return [f"  stopped after {counted(run.last.number, 'iteration')}: {stop.reason}", f"  {stop.advice}"]
