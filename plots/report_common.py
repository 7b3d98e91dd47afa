"""What every part of the report shares: what methods are called, numbers, words, and text that is safe in HTML."""

import html
import json
import math
import zlib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

from records import SCHEMAS, Experiment, Series

CORE = "polylidar"
# Which method tells the steps of another: both are one, as for the program.
TOLD_BY: dict[str, str] = json.loads((SCHEMAS / "paper.json").read_text(encoding="utf-8"))["steps"]["told_by"]

# How methods, steps and parts of pictures look on every page and figure.
LOOKS = json.loads((Path(__file__).resolve().parent / "methods.json").read_text(encoding="utf-8"))
METHOD_LOOKS = LOOKS["methods"]  # short title, what it is, place in the order, colours, marker and line
# Who chose the parameters, in words, and which protocols are compared with each other.
PROTOCOLS = json.loads((SCHEMAS.parent / "benchmarks" / "record" / "protocols.json").read_text(encoding="utf-8"))

STATUS_WORDS = {
    "ok": "ok",
    "timeout": "timed out",
    "memory": "out of memory",
    "crash": "crashed",
    "error": "ended with an error",
    "invalid_output": "gave an invalid polygon",
    "unsupported": "does not support the case",
    "not_installed": "not installed",
}
# Those that say nothing about the result.
NOT_TRIED = frozenset({"not_installed", "unsupported"})


def method_look(method: str) -> dict[str, Any]:
    """As methods.json has it. A method that is not in it gets one of its spare looks, by its name: the same everywhere."""
    spare = LOOKS["others"][zlib.crc32(method.encode()) % len(LOOKS["others"])]
    return METHOD_LOOKS.get(method) or {"title": method, "order": 1000, "paper": False, **spare}


def in_order(series: Iterable[Series]) -> list[Series]:
    """Without repetitions: the paper's methods first, then as methods.json says, then by name."""
    return sorted(set(series), key=lambda one: (method_look(one[0])["order"], one[0], one[1] != "paper", one[1]))


def method_title(experiments: Sequence[Experiment], method: str) -> str:
    for experiment in experiments:
        if method in experiment.methods:
            return experiment.methods[method]["title"]
    return method


def label(experiments: Sequence[Experiment], series: Series) -> str:
    """As the tables write it: CGAL alpha shape (paper)."""
    return f"{method_title(experiments, series.method)} ({series.protocol})"


def short_name(series: Series, among: Iterable[Series]) -> str:
    """The short title, with the protocol where the method is among the series more than once."""
    title = method_look(series[0])["title"]
    return f"{title} ({series[1]})" if sum(one[0] == series[0] for one in set(among)) > 1 else title


def asked(section: str, report: str, **what: str) -> str:
    """Where a link leads: in the report to its section, whose script does the rest; from another page to `report`, which is
    asked for it behind the # (report/front.js)."""
    return f"{report}#{text(urlencode(what))}" if report else f"#{section}"


def protocol_words(experiments: Sequence[Experiment]) -> dict[str, str]:
    """Who chose the parameters, by the protocols that the experiments have, in the records' words."""
    told: dict[str, str] = {}
    for experiment in experiments:
        told |= experiment.report["summary"].get("protocols", {})
    used = {series.protocol for experiment in experiments for series in experiment.series()}
    return {name: told.get(name, name) for name in sorted(used)}


def round_to(value: float, digits: int) -> float | int:
    """To significant digits; a whole number becomes an int, which is shorter in JSON."""
    rounded = float(f"{value:.{digits}g}")
    return int(rounded) if rounded.is_integer() and abs(rounded) < 1e15 else rounded


def number(value: float) -> str:
    """For people: three significant digits, no exponent between a thousandth and a million."""
    if math.isinf(value):
        return "∞"
    value = float(f"{value:.3g}")  # first, so that 0.9999 and 1 are written alike
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e6:
        digits = max(0, 2 - math.floor(math.log10(abs(value))))
        return f"{value:.{digits}f}"
    return f"{value:.3g}"


def count_of(count: int, noun: str) -> str:
    """1 case, 2 cases."""
    several = noun[:-1] + "ies" if noun.endswith("ry") else noun + "s"
    return f"{count} {noun if count == 1 else several}"


def sentence_list(words: Sequence[str]) -> str:
    """a, b and c."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def text(value: object) -> str:
    """Escaped for HTML text and attributes: whatever a record says stays text."""
    return html.escape(str(value), quote=True)
