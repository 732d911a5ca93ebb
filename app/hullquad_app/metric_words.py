"""What a metric is, in words: for tooltips, and for its name within a sentence."""

from math import isfinite
from textwrap import fill

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication

from hullquad.metrics import Band, Metric, Scale, Sense
from hullquad_app.panels.figures import plain

_WIDTH = 72
"""Letters in a line of a tooltip."""
_NAMES = ("Jacobian",)
"""Words that begin with a capital wherever they stand."""
_SENSES = {
    Sense.HIGHER: str(QT_TRANSLATE_NOOP("Metric", "higher is better, ideal is {ideal}")),
    Sense.LOWER: str(QT_TRANSLATE_NOOP("Metric", "lower is better, ideal is {ideal}")),
    Sense.NEARER: str(QT_TRANSLATE_NOOP("Metric", "the nearer to {ideal} the better")),
}


def meaning(by: Metric) -> str:
    """Formula, range, band, sense and source of a metric, on several lines."""
    lines = [
        _tr("{title}: {formula}").format(title=by.title, formula=by.formula),
        _tr("Quads: {scale}").format(scale=_scale_words(by, by.quads)),
        _triangle_words(by),
        _tr(_SENSES[by.sense]).format(ideal=plain(by.quads.ideal, by)),
        _tr("Source: {source}").format(source=by.source),
    ]
    return "\n".join(fill(line[:1].upper() + line[1:], _WIDTH, subsequent_indent="   ") for line in lines)


def accepted(by: Metric, band: Band) -> str:
    """A band in words: ``at least 0.25``, ``at most 4``, ``45° to 135°``."""
    low, high = (plain(end, by) for end in band)
    if not isfinite(band[0]):
        return _tr("at most {high}").format(high=high)
    return (
        _tr("{low} to {high}").format(low=low, high=high)
        if isfinite(band[1])
        else _tr("at least {low}").format(low=low)
    )


def name_of(by: Metric) -> str:
    """The metric's title within a sentence; names keep their capitals."""
    is_name = by.title[:2].isupper() or by.title.split(" ")[0] in _NAMES
    return by.title if is_name else by.title[:1].lower() + by.title[1:]


def _scale_words(by: Metric, scale: Scale) -> str:
    text = _tr("{low} to {high}, acceptable {band}")
    band = accepted(by, by.opened(scale.acceptable))
    return text.format(low=plain(scale.low, by), high=plain(scale.high, by), band=band)


def _triangle_words(by: Metric) -> str:
    if by.triangles is None:
        text = _tr("Triangles: judged by their {judge}, acceptable {band}")
        judge = by.triangle_metric
        return text.format(judge=name_of(judge), band=accepted(judge, by.triangle_band))
    return _tr("Triangles: {scale}").format(scale=_scale_words(by, by.triangles))


def _tr(text: str) -> str:
    return QCoreApplication.translate("Metric", text)
