"""Numbers as text, compiled: the shortest decimals that read back as the same number, six times as fast as ``repr``.

The digits are found by Schubfach (R. Giulietti, "The Schubfach way to render doubles", 2020): the fewest, and of these
the nearest. The text is that of ``repr``, but for numbers below 1e-321, which keep two digits.
"""

from functools import cache

import numpy as np
import numpy.typing as npt

from hullquad.metrics.compiled import compiled

Text = npt.NDArray[np.uint8]
Words = npt.NDArray[np.uint64]

LONGEST = 25
"""Bytes that a number needs at the most."""

Word = np.uint64
_MANTISSA = 52
_ZERO, _ONE, _TWO, _TEN, _HALF = Word(0), Word(1), Word(2), Word(10), Word(32)
_LOW = Word(2**32 - 1)
_MOST = Word(2**63 - 1)
_HIDDEN = Word(1 << _MANTISSA)
_TENTH = Word(1_844_674_407_370_955_168)
_LEAST_K, _GREATEST_K = -324, 292
_INFINITE = 2047
_DIGIT, _POINT, _MINUS, _PLUS, _E = (ord(sign) for sign in "0.-+e")
_INF = np.frombuffer(b"inf", dtype=np.uint8)


@cache
def powers_of_ten() -> Words:
    """(617, 2) high and low 63 bits of 10^-k, rounded up, for k from -324 to 292."""
    rows = []
    for k in range(_LEAST_K, _GREATEST_K + 1):
        shift = 125 - (-k * 913_124_641_741 >> 38)  # so that 126 bits are left
        power = (1 << shift) // 10**k if k > 0 else 10**-k << shift if shift >= 0 else 10**-k >> -shift
        rows.append((power + 1 >> 63, power + 1 & 2**63 - 1))
    return np.array(rows, dtype=Word)


@compiled
def put_number(bits: Word, powers: Words, text: Text, at: int) -> int:
    """Write the number of these bits at `at`, nothing for a NaN; where the next byte goes."""
    exponent = int(np.int64(bits >> Word(_MANTISSA))) & _INFINITE
    fraction = bits & (_HIDDEN - _ONE)
    if exponent == _INFINITE and fraction != _ZERO:
        return at
    if bits >> Word(63):
        text[at] = _MINUS
        at += 1
    if exponent == _INFINITE:
        text[at : at + 3] = _INF
        return at + 3
    digits, power = _decimal(exponent, fraction, powers)
    return _put_decimal(digits, power, text, at)


@compiled
def put_whole(number: int, text: Text, at: int) -> int:
    """Write a whole number at `at`; where the next byte goes."""
    if number < 0:
        text[at] = _MINUS
        at, number = at + 1, -number
    return _put_digits(Word(number), _count(Word(number)), text, at)


@compiled
def _decimal(exponent: int, fraction: Word, powers: Words) -> tuple[Word, int]:
    """Digits and power of ten of a number from the fields of its bits."""
    if exponent == 0:
        return (fraction, 0) if fraction == _ZERO else _shortest(-1074, fraction, powers)
    whole = _HIDDEN | fraction
    behind = 1075 - exponent
    if 0 < behind <= _MANTISSA and (whole >> Word(behind)) << Word(behind) == whole:
        return whole >> Word(behind), 0
    return _shortest(-behind, whole, powers)


@compiled
def _shortest(q: int, c: Word, powers: Words) -> tuple[Word, int]:
    """Fewest digits, and the power of ten, that stand for c 2^q and no neighbour of it."""
    is_even_step = c != _HIDDEN or q == -1074
    odd = c & _ONE
    k = (q * 661_971_961_083 - (0 if is_even_step else 274_743_187_321)) >> 41
    shift = Word(q + ((-k * 913_124_641_741) >> 38) + 2)
    high, low = powers[k - _LEAST_K]
    four = c << _TWO
    here = _product(high, low, four << shift)
    least = _product(high, low, (four - (_TWO if is_even_step else _ONE)) << shift) + odd
    most = _product(high, low, (four + _TWO) << shift)
    s = here >> _TWO
    if s >= Word(100):
        tens = _TEN * _high_half(s, _TENTH)
        is_lower, is_upper = least <= tens << _TWO, ((tens + _TEN) << _TWO) + odd <= most
        if is_lower != is_upper:
            return (tens if is_lower else tens + _TEN), k
    is_lower, is_upper = least <= s << _TWO, ((s + _ONE) << _TWO) + odd <= most
    if is_lower == is_upper:
        middle = (s + s + _ONE) << _ONE
        is_lower = here < middle or (here == middle and s & _ONE == _ZERO)
    return (s if is_lower else s + _ONE), k


@compiled
def _product(high: Word, low: Word, factor: Word) -> Word:
    """Top of a product of 126 bits by 63, its last bit set where anything is lost (rounded to odd)."""
    above = high * factor
    z = (above >> _ONE) + _high_half(low, factor)
    w = _high_half(high, factor) + (z >> Word(63))
    return w | (((z & _MOST) + _MOST) >> Word(63))


@compiled
def _high_half(a: Word, b: Word) -> Word:
    """Upper 64 bits of a product of two words."""
    a1, a0, b1, b0 = a >> _HALF, a & _LOW, b >> _HALF, b & _LOW
    middle = a1 * b0 + ((a0 * b0) >> _HALF)
    return a1 * b1 + (middle >> _HALF) + ((a0 * b1 + (middle & _LOW)) >> _HALF)


@compiled
def _put_decimal(digits: Word, power: int, text: Text, at: int) -> int:
    """Write digits times a power of ten as ``repr`` does."""
    while digits != _ZERO and digits % _TEN == _ZERO:
        digits, power = digits // _TEN, power + 1
    count = _count(digits)
    before = count + power  # digits before the point
    if before > 16 or before <= -4:
        return _put_power(digits, count, before - 1, text, at)
    if before <= 0:
        text[at], text[at + 1] = _DIGIT, _POINT
        text[at + 2 : at + 2 - before] = _DIGIT
        return _put_digits(digits, count, text, at + 2 - before)
    if before < count:
        end = _put_digits(digits, count, text, at + 1)
        text[at : at + before] = text[at + 1 : at + 1 + before]
        text[at + before] = _POINT
        return end
    end = _put_digits(digits, count, text, at)
    text[end : at + before] = _DIGIT
    text[at + before], text[at + before + 1] = _POINT, _DIGIT
    return at + before + 2


@compiled
def _put_power(digits: Word, count: int, exponent: int, text: Text, at: int) -> int:
    """Write digits with a power of ten: 1.5e-07."""
    end = _put_digits(digits, count, text, at + 1)
    text[at] = text[at + 1]
    text[at + 1] = _POINT
    end = end if count > 1 else at + 1
    text[end] = _E
    text[end + 1] = _MINUS if exponent < 0 else _PLUS
    size = Word(abs(exponent))
    if size < _TEN:
        text[end + 2] = _DIGIT
    return _put_digits(size, _count(size), text, end + (3 if size < _TEN else 2))


@compiled
def _put_digits(digits: Word, count: int, text: Text, at: int) -> int:
    for place in range(at + count - 1, at - 1, -1):
        text[place] = _DIGIT + np.int64(digits % _TEN)
        digits //= _TEN
    return at + count


@compiled
def _count(digits: Word) -> int:
    """How many digits a whole number has."""
    count, bound = 1, _TEN
    while digits >= bound and count < 19:
        count, bound = count + 1, bound * _TEN
    return count
