"""Colours say pass or fail by hue and how far by lightness, everywhere the same."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hullquad.metrics import METRICS, metric
from hullquad.quality import Quality
from hullquad_app.colours import (
    BROKEN,
    COLOUR_MAPS,
    DARK,
    INVERTED,
    LIGHT,
    UNJUDGED,
    Palette,
    Theme,
    colour,
    colour_map,
    element_colours,
    palette,
    rgb,
)

VALUES = st.lists(st.floats(0, 1), min_size=1, max_size=20)
TEXTS = ("text", "dim", "accent", "fail")


def judged(values, limit=0.25, key="stretch", valid=None):
    """Quality of quads with those values."""
    values = np.array(values, dtype=float)
    row = metric(key)
    valid = np.ones(len(values), dtype=bool) if valid is None else np.array(valid)
    band = row.opened((limit, limit))
    return Quality(
        metric=row,
        band=band,
        values=values,
        valid=valid,
        failing=~(row.is_within(band, values) & valid),
        is_triangle=np.zeros(len(values), dtype=bool),
    )


def named(colours):
    """Colours of elements as they are written."""
    return ["#" + bytes(row).hex().upper() for row in colours]


def luminance(name):
    """Relative luminance of WCAG 2."""
    channels = np.array(rgb(name)) / 255
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(one, other):
    """Contrast ratio of WCAG 2."""
    low, high = sorted([luminance(one), luminance(other)])
    return (high + 0.05) / (low + 0.05)


@given(VALUES)
def test_failing_elements_are_reddish_and_passing_ones_bluish(values):
    quality = judged(values)
    colours = element_colours(quality).astype(int)
    np.testing.assert_array_equal(colours[:, 0] > colours[:, 2], quality.failing)


@pytest.mark.parametrize("chosen", COLOUR_MAPS, ids=lambda chosen: chosen.key)
@given(values=VALUES)
def test_elements_have_the_colour_of_their_grade(chosen, values):
    quality = judged(values)
    expected = [colour(grade, chosen=chosen) for grade in quality.grades]
    assert named(element_colours(quality, chosen)) == expected


@pytest.mark.parametrize("row", METRICS, ids=lambda row: row.key)
def test_limit_and_ideal_pass_and_the_worst_value_is_darkest(row):
    sides = [row.worst[end] for end, limit in enumerate(row.band) if np.isfinite(limit)]
    for limit, worst in zip(row.limits(row.band), sides, strict=True):
        values = np.array([worst, limit, row.quads.ideal])
        quality = attrs.evolve(judged(values, key=row.key), band=row.band, failing=~row.is_within(row.band, values))
        assert named(element_colours(quality)) == ["#6E0A1E", "#E3EDF3", "#5E9DC4"]


def test_a_value_just_beyond_the_limit_fails_in_colour():
    just_below = np.nextafter(0.25, 0)
    assert named(element_colours(judged([just_below, 0.25]))) == ["#FDBB84", "#E3EDF3"]


def test_every_stop_is_met_exactly():
    grades = np.linspace(0, 1, 5)
    assert tuple(colour(grade) for grade in grades) == BROKEN.passing
    assert tuple(colour(grade) for grade in grades[:-1] - 1) == BROKEN.failing[:-1]


@pytest.mark.parametrize("chosen", COLOUR_MAPS, ids=lambda chosen: chosen.key)
def test_inverted_and_unjudged_elements_stand_apart_in_every_map(chosen):
    quality = judged([0.0, np.nan, 0.5], valid=[False, True, True])
    assert named(element_colours(quality, chosen))[:2] == [INVERTED, UNJUDGED]
    assert colour(-1.0, valid=False, chosen=chosen) == INVERTED
    assert colour(np.nan, chosen=chosen) == UNJUDGED


def test_a_map_that_is_gone_becomes_the_first():
    assert colour_map("cividis").key == "cividis"
    assert colour_map("jet") is BROKEN


@pytest.mark.parametrize("shown", [LIGHT, DARK], ids=["light", "dark"])
def test_texts_are_readable_on_every_ground(shown: Palette):
    for ground in (shown.background, shown.panel, shown.view):
        assert min(contrast(getattr(shown, name), ground) for name in TEXTS) >= 4.5


def test_every_colour_of_a_palette_can_be_read():
    for shown in (LIGHT, DARK):
        assert all(len(rgb(value)) == 3 for value in attrs.asdict(shown).values() if isinstance(value, str))


def test_the_system_decides_when_the_user_does_not():
    assert palette(Theme.SYSTEM, system_is_dark=True) is DARK
    assert palette(Theme.SYSTEM) is LIGHT
    assert palette(Theme.LIGHT, system_is_dark=True) is LIGHT
    assert palette(Theme.DARK) is DARK
