"""The bar above the view where errors are said, instead of in dialogs."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPlainTextEdit, QToolButton, QVBoxLayout

from hullquad.errors import HullquadError
from hullquad_app.colours import LIGHT, Palette
from hullquad_app.theme import icon

_DETAIL_LINES = 6


class MessageBar(QFrame):
    """A sentence that stays until it is closed or something else is said; more of it under "Details"."""

    def __init__(self) -> None:
        super().__init__()
        self.sentence = QLabel()
        self.sentence.setWordWrap(True)
        self.sentence.setTextFormat(Qt.TextFormat.PlainText)
        self.sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.details = QPlainTextEdit()
        self.details.setReadOnly(True)
        self.details.setFixedHeight(self.fontMetrics().lineSpacing() * _DETAIL_LINES)
        self.details.setAccessibleName(self.tr("Details of the message"))
        self.details_button = self._button(self.tr("Details"), self.tr("Show or hide where it is and what can be done"))
        self.details_button.setCheckable(True)
        self.details_button.toggled.connect(self.details.setVisible)
        self._sign = QLabel()
        self._close = self._button("", self.tr("Close this message"))
        self._close.clicked.connect(self.hide)
        self._lay_out()
        self.set_palette(LIGHT)
        self.hide()

    def say(self, message: HullquadError | str) -> None:
        """Show an error, or a text whose first line is the message and the rest details."""
        if isinstance(message, HullquadError):
            text = message.text
            sentence, details = text[:1].upper() + text[1:] + ".", f"{message.code} at {message.place}"
        else:
            sentence, _, details = message.partition("\n")
        self.sentence.setText(sentence)
        self.details.setPlainText(details)
        self.details_button.setVisible(bool(details))
        self.details_button.setChecked(False)
        self.details.hide()
        self.show()

    def set_palette(self, palette: Palette) -> None:
        """Take the colours of a theme."""
        self._sign.setPixmap(icon("warning", palette).pixmap(18, 18))
        self._close.setIcon(icon("close", palette))
        self.setObjectName("messages")
        self.setStyleSheet(
            f"#messages {{ background: {palette.panel}; border: 0; border-left: 4px solid {palette.fail}; "
            f"border-bottom: 1px solid {palette.rule}; }}"
        )

    def _button(self, text: str, tip: str) -> QToolButton:
        made = QToolButton()
        made.setText(text)
        made.setToolTip(tip)
        made.setAccessibleName(tip)
        made.setAutoRaise(True)
        return made

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self._sign)
        row.addWidget(self.sentence, stretch=1)
        row.addWidget(self.details_button)
        row.addWidget(self._close)
        column = QVBoxLayout(self)
        column.addLayout(row)
        column.addWidget(self.details)
