"""A box for numbers of any size, whose arrows go 1, 2, 5, 10, 20, 50."""

from math import floor, log10

from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QDoubleSpinBox

_MANTISSAS = (1.0, 2.0, 5.0)
_DECIMALS = 12


class ScaleSpin(QDoubleSpinBox):
    """Takes and shows ``0.003`` and ``1e-06``; emits its value when it is entered, not at every digit."""

    def __init__(self, least: float, most: float) -> None:
        super().__init__()
        self.setDecimals(_DECIMALS)
        self.setRange(least, most)
        self.setKeyboardTracking(False)

    def textFromValue(self, value: float) -> str:
        """Shortest text of a number."""
        return f"{value:.6g}"

    def valueFromText(self, text: str) -> float:
        """Number of a text, with a point or a comma."""
        return _number(self._bare(text))

    def validate(self, text: str, place: int) -> tuple[QValidator.State, str, int]:
        """Whether the text is a number within the range, or may become one."""
        try:
            value = _number(self._bare(text))
        except ValueError:
            is_on_the_way = not self._bare(text).strip("0123456789.,eE-+ ")
            return QValidator.State.Intermediate if is_on_the_way else QValidator.State.Invalid, text, place
        fits = self.minimum() <= value <= self.maximum()
        return QValidator.State.Acceptable if fits else QValidator.State.Intermediate, text, place

    def stepBy(self, steps: int) -> None:
        """Go on in the series."""
        for _ in range(abs(steps)):
            self.setValue(_next(self.value()) if steps > 0 else 1 / _next(1 / self.value()))

    def _bare(self, text: str) -> str:
        return text.removeprefix(self.prefix()).removesuffix(self.suffix()).strip()


def _number(text: str) -> float:
    return float(text.replace(",", "."))


def _next(value: float) -> float:
    """Next number of the series above a value."""
    exponent = floor(log10(value))
    series = (mantissa * 10.0**power for power in (exponent, exponent + 1) for mantissa in _MANTISSAS)
    return next(number for number in series if number > value * (1 + 1e-9))
