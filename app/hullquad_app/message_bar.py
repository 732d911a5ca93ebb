"""The bar above the view where errors are said, instead of in dialogs."""

from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QStyle, QToolButton


class MessageBar(QFrame):
    """A sentence that stays until it is closed or something else succeeds."""

    def __init__(self) -> None:
        super().__init__()
        self.sentence = QLabel()
        self.sentence.setWordWrap(True)
        close = QToolButton()
        close.setIcon(self.style().standardIcon(QStyle.StandardPixmap.SP_TitleBarCloseButton))
        close.setToolTip(self.tr("Close this message"))
        close.setAutoRaise(True)
        close.clicked.connect(self.hide)
        layout = QHBoxLayout(self)
        layout.addWidget(self.sentence, stretch=1)
        layout.addWidget(close)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.hide()

    def say(self, sentence: str) -> None:
        """Show a sentence."""
        self.sentence.setText(sentence)
        self.show()
