"""What is said of an element below the cursor."""

from PySide6.QtCore import QCoreApplication

from hullquad.quality import Quality
from hullquad.topology import Topology


def tip(topology: Topology, quality: Quality, row: int) -> str:
    """Label, kind and value of an element: ``element 131 · quad · stretch 0.467``."""
    is_triangle = bool(topology.is_triangle[row])
    kind = _translated("triangle") if is_triangle else _translated("quad")
    parts = [_translated("element {label}").format(label=topology.element_labels[row]), kind]
    if quality.valid[row]:
        judge = quality.metric.triangle_metric if is_triangle else quality.metric
        title = judge.title[0].lower() + judge.title[1:]
        parts.append(f"{title} {quality.values[row]:.3f}{judge.unit}")
    else:
        parts.append(_translated("inverted"))
    if quality.failing[row]:
        parts.append(_translated("FAIL"))
    return " · ".join(parts)


def _translated(text: str) -> str:
    return QCoreApplication.translate("Canvas", text)
