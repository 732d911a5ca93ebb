"""Files of rules and of criteria: what is read from them, and what is refused."""

import json
from math import inf, nan
from random import Random

import numpy as np
import pytest

from hullquad.errors import FileError, HullquadError, RuleError
from hullquad.metrics import METRICS, metric
from hullquad.rules import MEASURES, Elements, Status, read_rule_set, rule_set
from hullquad.rules.criteria import read_criteria, write_criteria

SOUND = {
    "format": "hullquad rules",
    "version": 1,
    "title": "Our yard",
    "rules": [
        {"measure": "aspect_ratio", "elements": "quads", "warn": [None, 2], "error": [None, 4], "status": "read"},
        {"measure": "aspect_ratio", "elements": "triangles", "error": [None, 3]},
        {"measure": "corner_angle", "warn": [45, 135]},
        {"title": "Elements over the depth", "not_evaluated": "depths are unknown"},
    ],
}  # fmt: skip


def saved(path, document):
    path.write_text(document if isinstance(document, str) else json.dumps(document), encoding="utf-8")
    return path


def test_a_users_file_is_read_like_a_built_in_one(tmp_path):
    found = rule_set(saved(tmp_path / "yard.json", SOUND))
    assert (found.key, found.title, found.edition) == ("Our yard", "Our yard", "")
    first, second, third, last = found.rules
    assert (first.warn, first.error, first.elements, first.status) == (
        (-inf, 2),
        (-inf, 4),
        Elements.QUADS,
        Status.READ,
    )
    assert (second.warn, second.error, second.status) == (None, (-inf, 3), Status.UNVERIFIED)
    assert (third.title, third.elements, third.warn) == (metric("corner_angle").title, Elements.ALL, (45, 135))
    assert (last.measure, last.not_evaluated) == ("", "depths are unknown")


def changed(*path, to):
    """The sound document with something else at a path; removed where that is ...."""
    document = json.loads(json.dumps(SOUND))
    *way, last = path
    inner = document
    for step in way:
        inner = inner[step]
    if to is ...:
        del inner[last]
    else:
        inner[last] = to
    return document


@pytest.mark.parametrize(
    ("document", "code", "place", "words"),
    [
        ("", "E_JSON", " line 1 column 1", "the file is empty"),
        ("{", "E_JSON", " line 1 column 2", "this is no JSON"),
        ('{"format": 1, "format": 2}', "E_JSON", "#/format", "given twice"),
        ("[]", "E_TYPE", "#", "an object in braces"),
        (changed("format", to="hullplate"), "E_FORMAT", "#/format", '"format": "hullquad rules"'),
        (changed("format", to=...), "E_FORMAT", "#/format", "nothing"),
        (changed("version", to=2), "E_VERSION", "#/version", "newer program"),
        (changed("version", to=True), "E_VERSION", "#/version", "reads version 1"),
        (changed("title", to=...), "E_RULE", "#/title", "title is missing"),
        (changed("title", to=" "), "E_RULE", "#/title", "the text is empty"),
        (changed("rule", to=[]), "E_KEY", "#/rule", "did you mean rules?"),
        (changed("rules", to=[]), "E_RULE", "#/rules", "there are no rules"),
        (changed("rules", to={}), "E_TYPE", "#/rules", "a list in square brackets"),
        (changed("rules", 0, "measure", to="aspect ratio"), "E_MEASURE", "#/rules/0/measure", "mean aspect_ratio?"),
        (changed("rules", 0, "measure", to="beauty"), "E_MEASURE", "#/rules/0/measure", "known are stretch"),
        (changed("rules", 0, "measure", to=7), "E_MEASURE", "#/rules/0/measure", "there is no measure 7"),
        (changed("rules", 0, "measure", to=...), "E_RULE", "#/rules/0/measure", "measure is missing"),
        (changed("rules", 0, "elements", to="quad"), "E_CHOICE", "#/rules/0/elements", "did you mean quads?"),
        (changed("rules", 0, "status", to="sure"), "E_CHOICE", "#/rules/0/status", "read, unverified"),
        (changed("rules", 0, "warning", to=[1, 2]), "E_KEY", "#/rules/0/warning", "did you mean warn?"),
        (changed("rules", 0, "warn", to=[3, 2]), "E_BAND", "#/rules/0/warn", "exchange the two"),
        (changed("rules", 0, "warn", to=[None, None]), "E_BAND", "#/rules/0/warn", "limits nothing"),
        (changed("rules", 0, "warn", to=[1, 2, 3]), "E_BAND", "#/rules/0/warn", "as in [null, 3]"),
        (changed("rules", 0, "warn", to=2), "E_BAND", "#/rules/0/warn", "as in [null, 3]"),
        (changed("rules", 0, "warn", to=[None, "2"]), "E_NUMBER", "#/rules/0/warn/1", "a number belongs here"),
        (changed("rules", 0, "warn", to=[None, float("nan")]), "E_NUMBER", "#/rules/0/warn/1", "nan is no number"),
        (changed("rules", 0, "warn", to=[None, float("inf")]), "E_NUMBER", "#/rules/0/warn/1", "inf is no number"),
        (changed("rules", 0, "warn", to=[None, 5]), "E_BAND", "#/rules/0/warn", "warn accepts what is an error"),
        (changed("rules", 1, to={"measure": "shape"}), "E_RULE", "#/rules/1", "neither warn nor error"),
        (changed("rules", 1, "elements", to="all"), "E_RULE", "#/rules/1", "limits aspect_ratio of these elements too"),
        (changed("rules", 2, "measure", to="stretch"), "E_RULE", "#/rules/2/elements", 'add "elements": "quads"'),
        (changed("rules", 3, "warn", to=[0, 1]), "E_RULE", "#/rules/3", "not evaluated has no measure"),
        (changed("rules", 3, "title", to=...), "E_RULE", "#/rules/3/title", "title is missing"),
    ],
)  # fmt: skip
def test_a_faulty_file_is_one_error_with_place_and_remedy(document, code, place, words, tmp_path):
    path = saved(tmp_path / "yard.json", document)
    with pytest.raises(RuleError) as refused:
        read_rule_set(path)
    error = refused.value
    assert (error.code, error.place) == (code, f"{path}{place}")
    assert words in error.text
    assert "\n" not in error.text


def test_all_faults_are_counted(tmp_path):
    document = changed("rules", 0, "warn", to=[3, 2])
    document["rules"][1]["error"] = "none"
    with pytest.raises(RuleError, match=r"exchange the two \(and 1 more error\)"):
        read_rule_set(saved(tmp_path / "yard.json", document))


def test_what_is_no_file_of_rules_is_refused(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        rule_set(tmp_path / "none.json")
    with pytest.raises(FileError, match="this is a folder"):
        read_rule_set(tmp_path)
    (tmp_path / "latin.json").write_bytes(b'{"title": "\xe9"}')
    with pytest.raises(FileError, match="UTF-8"):
        read_rule_set(tmp_path / "latin.json")
    with pytest.raises(FileError, match=r"2\.0 MiB, more than the 1 MiB"):
        read_rule_set(saved(tmp_path / "huge.json", " " * (2 << 20)))
    with pytest.raises(RuleError, match="too deep"):
        read_rule_set(saved(tmp_path / "deep.json", "[" * 200_000))


ATOMS = [None, True, False, 0, 1, 2.5, -3, 1e308, 10**400, inf, -inf, nan, "", " ", "é\x00", "quads", "read", "shape"]
KEYS = ["measure", "warn", "error", "elements", "status", "title", "not_evaluated", "x"]


def anything(rng, depth):
    """Whatever can stand in a file, made of what rules are made of."""
    kind = rng.choice(["atom", "atom", "list", "object"]) if depth else "atom"
    if kind == "atom":
        return rng.choice(ATOMS)
    if kind == "list":
        return [anything(rng, depth - 1) for _ in range(rng.randrange(4))]
    return {rng.choice(KEYS): anything(rng, depth - 1) for _ in range(rng.randrange(6))}


def whatever():
    """Rules of which each part was replaced by each atom, and rules that are anything."""
    yield from (changed("rules", 0, key, to=atom) for key in KEYS for atom in ATOMS)
    yield from (changed("rules", 0, key, to=[1, atom]) for key in ("warn", "error") for atom in ATOMS)
    yield from (changed(key, to=atom) for key in SOUND for atom in ATOMS)
    rng = Random(1)
    for _ in range(250):
        strange = {key: anything(rng, 2) for key in rng.sample(KEYS, 2)}
        yield changed("rules", 0, to={"measure": "shape", "warn": [0.5, None], **strange})


def test_whatever_stands_in_a_file_there_is_a_set_or_an_error(tmp_path):
    read = 0
    for document in whatever():
        path = saved(tmp_path / "any.json", document)
        try:
            read += bool(read_rule_set(path).rules)
        except HullquadError as error:
            assert str(path) in str(error)  # noqa: PT017  which of the two it is does not matter
    assert read > 10


def test_every_measure_has_a_title_of_its_own():
    titles = [measure.title for measure in MEASURES.values()]
    assert len(set(titles)) == len(titles)


def test_criteria_come_back_as_they_were_written(tmp_path):
    rng = np.random.default_rng(1)
    path = tmp_path / "criteria.json"
    for count in (0, 1, *rng.integers(1, len(METRICS) + 1, 20)):
        ends = np.sort(rng.choice([-1, 1], (count, 2)) * 10.0 ** rng.uniform(-15, 15, (count, 2)), axis=1)
        ends[rng.random(count) < 0.3, 0] = -inf
        ends[(rng.random(count) < 0.3) & np.isfinite(ends[:, 0]), 1] = inf
        keys = rng.permutation([row.key for row in METRICS])[:count]
        criteria = {str(key): (low, high) for key, (low, high) in zip(keys, ends.tolist(), strict=True)}
        write_criteria(criteria, path)
        assert read_criteria(path) == criteria


def test_criteria_are_written_in_the_order_of_the_table(tmp_path):
    path = tmp_path / "criteria.json"
    write_criteria({"shape": (0.4, inf), "stretch": (0.5, inf)}, path)
    assert json.loads(path.read_text(encoding="utf-8")) == {
        "format": "hullquad criteria", "version": 1, "bands": {"stretch": [0.5, None], "shape": [0.4, None]},
    }  # fmt: skip
    assert list(read_criteria(path)) == ["stretch", "shape"]


@pytest.mark.parametrize(
    ("bands", "code", "place"),
    [
        ({"strech": [0, 1]}, "E_MEASURE", "#/bands/strech"),
        ({"edge_over_size": [0, 1]}, "E_MEASURE", "#/bands/edge_over_size"),
        ({"stretch": [2, 1]}, "E_BAND", "#/bands/stretch"),
        ({"stretch": [None, None]}, "E_BAND", "#/bands/stretch"),
        ({"stretch": [float("nan"), 1]}, "E_NUMBER", "#/bands/stretch/0"),
        ([], "E_TYPE", "#/bands"),
    ],
)
def test_faulty_criteria_are_one_error(bands, code, place, tmp_path):
    path = saved(tmp_path / "criteria.json", {"format": "hullquad criteria", "version": 1, "bands": bands})
    with pytest.raises(RuleError) as refused:
        read_criteria(path)
    assert (refused.value.code, refused.value.place) == (code, f"{path}{place}")


def test_rules_are_no_criteria(tmp_path):
    with pytest.raises(RuleError, match='"format": "hullquad criteria"'):
        read_criteria(saved(tmp_path / "yard.json", SOUND))
