"""The stages of a run, in words that fit a label."""

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication

from hullquad_app.mesh_words import STEPS, step_words

_WORDS = {
    "untangle": str(QT_TRANSLATE_NOOP("Stage", "open folds")),
    "even out": str(QT_TRANSLATE_NOOP("Stage", "even out")),
    "worst first": str(QT_TRANSLATE_NOOP("Stage", "worst first")),
    "fewest violations": str(QT_TRANSLATE_NOOP("Stage", "fewest violations")),
}
_THEN_THE_SUM = "then the sum, "


def stage_words(stage: str) -> str:
    """What the optimiser was about; exponents as they are: ``p = 16``."""
    if stage.startswith(_THEN_THE_SUM):
        return _tr("sum, {stage}").format(stage=stage.removeprefix(_THEN_THE_SUM))
    if stage in STEPS:
        return step_words(stage)
    return _tr(_WORDS[stage]) if stage in _WORDS else stage


def _tr(text: str) -> str:
    return QCoreApplication.translate("Stage", text)
