"""Numbers as people read them: three significant decimals, figures of one width."""

from math import isinf

from PySide6.QtGui import QFont

from hullquad.metrics import Metric

CAPTION = 0.85
"""Size of a caption over that of the font."""
KEY = 1.5
"""Size of a key figure over that of the font."""


def shown(value: float, by: Metric) -> str:
    """A value of a metric, without its unit; every value of a metric has the same number of decimals."""
    if isinf(value):
        return "∞" if value > 0 else "−∞"
    decimals = 1 if by.unit else 3 if by.quads.high <= 1 else 2
    return signed(f"{value:.{decimals}f}" if abs(value) < 1e4 else f"{value:.2e}")


def valued(value: float, by: Metric) -> str:
    """The same with its unit."""
    return shown(value, by) + unit_of(by)


def unit_of(by: Metric) -> str:
    """The unit as it is written behind a number."""
    return f"\N{NO-BREAK SPACE}{by.unit}" if by.unit.isalpha() else by.unit


def summed(objective: float, by: Metric | None) -> str:
    """A sum of values of a metric, with its unit; of several metrics, which has none."""
    if isinf(objective):
        return "∞" if objective > 0 else "−∞"
    return signed(f"{objective:.3f}" if by is None or not by.unit else f"{objective:.1f}{unit_of(by)}")


def plain(value: float, by: Metric) -> str:
    """A value as short as it can be, with its unit: of limits and ends of bins."""
    return "∞" if isinf(value) else signed(f"{value:.4g}{unit_of(by)}")


def counted(number: int) -> str:
    """A number of things, its thousands apart."""
    return f"{number:,}".replace(",", "\N{NARROW NO-BREAK SPACE}")


def signed(text: str) -> str:
    """The text with a true minus."""
    return text.replace("-", "−")


def sized(font: QFont, factor: float = 1.0) -> QFont:
    """The font in another size, its figures all of one width so that numbers do not jump."""
    other = QFont(font)
    if font.pointSizeF() > 0:
        other.setPointSizeF(font.pointSizeF() * factor)
    else:
        other.setPixelSize(round(font.pixelSize() * factor))
    other.setFeature(QFont.Tag("tnum"), 1)
    return other
