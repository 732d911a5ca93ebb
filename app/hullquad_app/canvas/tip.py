"""What is said of an element below the cursor."""

from PySide6.QtCore import QCoreApplication

from hullquad.arrays import Bools
from hullquad.quality import Quality
from hullquad.topology import Topology
from hullquad_app.metric_words import name_of
from hullquad_app.panels.figures import valued
from hullquad_app.verdict_words import fate


def tip(topology: Topology, quality: Quality, row: int, given: Bools | None = None) -> str:
    """Label, kind, value and fate of an element: ``element 131 · quad · stretch 0.467 · FAIL, given``."""
    is_triangle = bool(topology.is_triangle[row])
    kind = _translated("triangle") if is_triangle else _translated("quad")
    parts = [_translated("element {label}").format(label=topology.element_labels[row]), kind]
    if quality.valid[row]:
        judge = quality.metric.triangle_metric if is_triangle else quality.metric
        parts.append(f"{name_of(judge)} {valued(float(quality.values[row]), judge)}")
    if quality.failing[row]:
        parts.append(fate(quality, given, row).word)
    return " · ".join(parts)


def _translated(text: str) -> str:
    return QCoreApplication.translate("Canvas", text)
