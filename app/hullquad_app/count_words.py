"""Numbers of things in words: one of them, or several."""

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication

from hullquad_app.panels.figures import counted


def _tr(text: str) -> str:
    return str(QT_TRANSLATE_NOOP("CountWords", text))


_WORDS = {
    "quad": (_tr("{count} quad"), _tr("{count} quads")),
    "triangle": (_tr("{count} triangle"), _tr("{count} triangles")),
    "node": (_tr("{count} node"), _tr("{count} nodes")),
    "element": (_tr("{count} element"), _tr("{count} elements")),
    "iteration": (_tr("{count} iteration"), _tr("{count} iterations")),
}


def number_of(noun: str, count: int) -> str:
    """``1 triangle``, ``2 triangles``; the thousands of large numbers apart."""
    one, several = _WORDS[noun]
    return QCoreApplication.translate("CountWords", one if count == 1 else several).format(count=counted(count))
