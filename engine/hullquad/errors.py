"""What can go wrong, as values: a code, a place and numbers; the sentences are in one table."""

from typing import Any, Self

from hullquad.sentences import SENTENCES


class HullquadError(Exception):
    """Something the user can mend.

    Parameters
    ----------
    code : str
        Key of `sentences.SENTENCES` up to a colon: ``E_HOLE_OUTSIDE``.
    place : str
        Where: a path in the document (``/plates/0/holes/1``), a file, or ``line L column C``.
    case : str
        Which of the code's sentences, when it has several: ``E_JSON`` + ``syntax``.
    numbers
        What the sentence quotes, by name.
    """

    def __init__(self, code: str, place: str, case: str = "", **numbers: Any) -> None:
        super().__init__(code, place, case, numbers)
        self.code = code
        self.place = place
        self.case = case
        self.numbers = numbers

    @property
    def key(self) -> str:
        """Key of the sentence: ``E_JSON`` or ``E_JSON:syntax``."""
        return f"{self.code}:{self.case}" if self.case else self.code

    @property
    def text(self) -> str:
        """The English sentence: which plate, what is wrong, where, what to do."""
        plate = SENTENCES["OF_PLATE"].format(plate=self.numbers["plate"]) if self.numbers.get("plate") else ""
        return plate + SENTENCES[self.key].format(**self.numbers)

    def concerning(self, plate: str) -> Self:
        """The same error, telling the id of the plate."""
        return type(self)(self.code, self.place, self.case, **{**self.numbers, "plate": plate})

    def at(self, place: str) -> Self:
        """The same error at another place."""
        return type(self)(self.code, place, self.case, **self.numbers)

    def __str__(self) -> str:
        return f"{self.code} at {self.place}: {self.text}"

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuilt, (type(self), self.code, self.place, self.case, self.numbers)


class DocumentError(HullquadError):
    """A document that cannot be used; `others` among the numbers counts its further faults."""

    def among(self, others: int) -> Self:
        """The same error, knowing how many others there are."""
        return type(self)(self.code, self.place, self.case, **{**self.numbers, "others": others})

    @property
    def others(self) -> int:
        """Number of further faults in the same document."""
        return int(self.numbers.get("others", 0))

    @property
    def text(self) -> str:
        """The English sentence, and how many further faults there are."""
        more = "MORE:one" if self.others == 1 else "MORE"
        return super().text + (SENTENCES[more].format(others=self.others) if self.others else "")


class PlateError(DocumentError):
    """A plate document that cannot be used."""


class RuleError(DocumentError):
    """A file of rules or criteria that cannot be used."""


class FileError(HullquadError):
    """A file that cannot be read or written."""


class MeshError(HullquadError):
    """A mesh that cannot be used."""


class MeshingError(HullquadError):
    """A plate that could not be meshed."""


def _rebuilt(kind: type[HullquadError], code: str, place: str, case: str, numbers: dict[str, Any]) -> HullquadError:
    return kind(code, place, case, **numbers)
