"""What is written above the plate in a picture for a report: what it is, and its key figures."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication

from hullquad.quality import Quality
from hullquad_app.colours import INVERTED, LIGHT
from hullquad_app.count_words import number_of
from hullquad_app.limits import limit_words
from hullquad_app.metric_words import name_of
from hullquad_app.panels.figures import counted, valued
from hullquad_app.pen import Pen
from hullquad_app.scene import Scene
from hullquad_app.stage_words import stage_words

if TYPE_CHECKING:
    from hullquad.rules import Assessment

MARGIN = 48
HEADER, FOOTER = 128, 116
"""Heights of what is above and below the plate."""
_TITLE, _LINE, _CAPTION, _FIGURE = 26, 18, 15, 26
_COLUMN, _GAP = 100, 36
"""Least width of a key figure, and room between two of them."""


def write_header(pen: Pen, width: float, scene: Scene, quality: Quality) -> None:
    """Plate, metric, limit and iteration on the left; worst, mean and failing on the right."""
    right = width - MARGIN
    for caption, value, colour in reversed(_figures(scene, quality)):
        pen.write(right, 62, caption, _CAPTION, LIGHT.dim, anchor="rs")
        pen.write(right, 97, value, _FIGURE, colour, anchor="rs")
        right -= max(_COLUMN, pen.width(value, _FIGURE), pen.width(caption, _CAPTION)) + _GAP
    room = right - MARGIN
    pen.write(MARGIN, 64, pen.fitting(_title(scene), room, _TITLE, bold=True), _TITLE, LIGHT.text, bold=True)
    pen.write(MARGIN, 97, pen.fitting(_line(scene, quality), room, _LINE), _LINE, LIGHT.dim)


def _title(scene: Scene) -> str:
    return (scene.plate.title if scene.plate is not None else "") or scene.view.key or scene.state.title


def _line(scene: Scene, quality: Quality) -> str:
    count = len(quality.values)
    parts = [scene.plate.id] if scene.plate is not None and scene.plate.title else []
    parts += _yardstick(scene, quality)
    if scene.stage is not None and scene.iterate is not None:
        parts.append(stage_words(scene.iterate.stage))
    elif scene.track is not None and len(scene.track.iterates) > 1 and scene.iterate is not None:
        last = scene.track.last.number
        parts.append(_tr("iteration {number} of {last}").format(number=scene.iterate.number, last=last))
    parts.append(number_of("element", count))
    return " · ".join(parts)


def _yardstick(scene: Scene, quality: Quality) -> list[str]:
    """By what the elements are judged."""
    if scene.assessment is not None:
        rules = scene.assessment.rule_set
        return [rules.title] if not rules.edition else [f"{rules.title} ({rules.edition})"]
    by = quality.metric
    parts = [by.title, _tr("limit {limit}").format(limit=limit_words(by, quality.band))]
    if by.triangles is None and quality.is_triangle.any():
        parts.append(_tr("triangles by {judge}").format(judge=name_of(by.triangle_metric)))
    return parts


def _figures(scene: Scene, quality: Quality) -> list[tuple[str, str, str]]:
    """Caption, value and colour of the key figures, from left to right."""
    rows = _of_metric(scene, quality) if scene.assessment is None else _of_rules(scene.assessment)
    inverted = (_tr("inverted"), counted(quality.inverted_count), INVERTED)
    return [*rows, inverted] if quality.inverted_count else rows


def _of_metric(scene: Scene, quality: Quality) -> list[tuple[str, str, str]]:
    by, alarm = quality.metric, LIGHT.fail if quality.failing_count else LIGHT.text
    failing = _tr("{failing} of {count}").format(
        failing=counted(quality.failing_count), count=counted(len(quality.values))
    )
    worst = LIGHT.fail if quality.failing[quality.worst_element] else LIGHT.text
    given = 0 if scene.given is None else int(scene.given.sum())
    caption = _tr("failing, {count} given by the contour").format(count=counted(given)) if given else _tr("failing")
    return [
        (_tr("worst"), valued(quality.worst, by), worst),
        (_tr("mean"), valued(quality.mean, by), LIGHT.text),
        (caption, failing, alarm),
    ]


def _of_rules(assessment: "Assessment") -> list[tuple[str, str, str]]:
    ok, warn, fail = assessment.counts.values()
    rows = [
        (_tr("ok"), counted(ok), LIGHT.text),
        (_tr("warn"), counted(warn), LIGHT.text),
        (_tr("fail"), counted(fail), LIGHT.fail if fail else LIGHT.text),
    ]
    given = int(assessment.given.sum())
    return [*rows, (_tr("given by the contour"), counted(given), LIGHT.text)] if given else rows


def _tr(text: str) -> str:
    return QCoreApplication.translate("Picture", text)
