"""How the program looks: one palette for Qt's widgets, the view and the plots, and icons in its colours."""

from PySide6.QtCore import QByteArray, Qt
from PySide6.QtGui import QColor, QIcon, QImage, QPainter, QPalette, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QApplication

from hullquad_app import assets
from hullquad_app.colours import DARK, LIGHT, Palette, Theme

_SCHEMES = {
    Theme.SYSTEM: Qt.ColorScheme.Unknown,
    Theme.LIGHT: Qt.ColorScheme.Light,
    Theme.DARK: Qt.ColorScheme.Dark,
}
_ICON_SIDE = 20
_SHARPNESS = 4
"""Pixels of an icon per unit of its drawing: enough for screens of scale 3."""


def apply(theme: Theme) -> Palette:
    """Give the application a theme; the palette for whatever Qt does not paint."""
    application = QApplication.instance()
    assert isinstance(application, QApplication)  # there are widgets
    hints = application.styleHints()
    hints.setColorScheme(_SCHEMES[theme])
    # a platform without themes keeps its scheme whatever is set
    is_dark = hints.colorScheme() == Qt.ColorScheme.Dark if theme is Theme.SYSTEM else theme is Theme.DARK
    palette = DARK if is_dark else LIGHT
    application.setPalette(widget_palette(palette))
    application.setStyleSheet(_style_sheet(palette))
    return palette


def widget_palette(palette: Palette) -> QPalette:
    """Qt's palette of ours."""
    roles = {
        QPalette.ColorRole.Window: palette.background,
        QPalette.ColorRole.Base: palette.panel,
        QPalette.ColorRole.AlternateBase: palette.background,
        QPalette.ColorRole.Button: palette.background,
        QPalette.ColorRole.ToolTipBase: palette.panel,
        QPalette.ColorRole.WindowText: palette.text,
        QPalette.ColorRole.Text: palette.text,
        QPalette.ColorRole.ButtonText: palette.text,
        QPalette.ColorRole.ToolTipText: palette.text,
        QPalette.ColorRole.PlaceholderText: palette.dim,
        QPalette.ColorRole.Highlight: palette.accent,
        QPalette.ColorRole.HighlightedText: "#FFFFFF" if not palette.is_dark else "#0E1216",
        QPalette.ColorRole.Accent: palette.accent,
        QPalette.ColorRole.Link: palette.accent,
        QPalette.ColorRole.Mid: palette.rule,
        QPalette.ColorRole.Midlight: palette.rule,
    }
    made = QPalette(QColor(palette.background))
    for role, colour in roles.items():
        made.setColor(role, QColor(colour))
    for role in (QPalette.ColorRole.WindowText, QPalette.ColorRole.Text, QPalette.ColorRole.ButtonText):
        made.setColor(QPalette.ColorGroup.Disabled, role, QColor(_between(palette.dim, palette.background)))
    return made


def icon(name: str, palette: Palette) -> QIcon:
    """The icon of that name in the palette's colours."""
    made = QIcon()
    made.addPixmap(_drawn(name, palette.text), QIcon.Mode.Normal)
    made.addPixmap(_drawn(name, _between(palette.dim, palette.background)), QIcon.Mode.Disabled)
    return made


def _drawn(name: str, colour: str) -> QPixmap:
    drawing = (assets.FOLDER / "icons" / f"{name}.svg").read_text(encoding="utf-8").replace("#000000", colour)
    image = QImage(_ICON_SIDE * _SHARPNESS, _ICON_SIDE * _SHARPNESS, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    QSvgRenderer(QByteArray(drawing.encode())).render(painter)
    painter.end()
    return QPixmap.fromImage(image)


def _between(one: str, other: str) -> str:
    a, b = QColor(one), QColor(other)
    return QColor((a.red() + b.red()) // 2, (a.green() + b.green()) // 2, (a.blue() + b.blue()) // 2).name()


def _style_sheet(palette: Palette) -> str:
    return f"""
        QMainWindow::separator {{ background: {palette.rule}; width: 1px; height: 1px; }}
        QToolBar {{ background: {palette.background}; border: 0; border-bottom: 1px solid {palette.rule};
                    padding: 4px 6px; spacing: 2px; }}
        QToolBar QToolButton {{ padding: 4px 5px; border-radius: 4px; border: 1px solid transparent; }}
        QToolBar QToolButton:hover:enabled {{ background: {palette.panel}; border-color: {palette.rule}; }}
        QToolBar QToolButton:pressed {{ background: {palette.rule}; }}
        QToolBar QToolButton:focus {{ border-color: {palette.accent}; }}
        QDockWidget {{ font-weight: 600; }}
        QDockWidget::title {{ background: {palette.background}; padding: 4px 10px; text-align: left;
                              border-bottom: 1px solid {palette.rule}; }}
        QTabBar::tab {{ padding: 4px 10px; color: {palette.dim}; border: 0; border-top: 2px solid transparent; }}
        QTabBar::tab:hover {{ color: {palette.text}; }}
        QTabBar::tab:selected {{ color: {palette.text}; background: {palette.panel}; border-color: {palette.accent}; }}
        QStatusBar {{ background: {palette.background}; border-top: 1px solid {palette.rule};
                      color: {palette.dim}; }}
        QStatusBar::item {{ border: 0; }}
        QToolTip {{ background: {palette.panel}; color: {palette.text}; border: 1px solid {palette.rule};
                    padding: 3px 5px; }}
    """
