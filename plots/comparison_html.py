"""The parts of the comparison that need no script: the verdict, what changed beside the times, what differs between the
runs, and what only one of them has. Colours never say anything alone: a sign and a word stand beside them."""

from collections import Counter
from collections.abc import Callable, Sequence

from comparison_data import Comparison, MethodChange, Pair
from markup import details, finding, list_of, named, notes_of, row_of, table_of
from records import Experiment, Series
from report_common import STATUS_WORDS, count_of, label, number, sentence_list, text
from report_html import entry_parameters, environment_facts, methods_of

SIGNS = {
    "faster": "▼",
    "slower": "▲",
    "not told apart": "○",
    "not judged": "·",
    "now fails": "✕",
    "now works": "✓",
    "fails in both": "–",
    "lower time": "▽",
    "higher time": "△",
}

# So many runs are named in a list; the table of all runs has every one.
MOST_NAMED = 12

# Wholly different in any two runs, so a difference says nothing.
ALWAYS_OTHER = {"Begun", "Load before the run", "Temperature, °C"}

NOT_EQUAL = (
    "“Not told apart” is not “equal”: no difference was shown, which does not say that there is none. "
    "“Not judged” are runs with too few repetitions for any difference to be shown."
)
SAME_PROGRAM = (
    "Two runs of the very same program differ, too, and often in most of their runs: the moment, the memory’s "
    "layout and neighbours on the machine change between runs, while the intervals and tests know the spread "
    "of the repetitions within these two runs only. Compare A with a second run of A to see how much that is; "
    "to judge a change of the code measure both in turns, as ‘make bench-gate’ does."
)
HOW_JUDGED = (
    "A run is faster or slower where the rank test of Mann and Whitney says so at 5 % after Holm’s correction over "
    "all runs judged. A method is faster or slower where the 95 % interval of its median ratio, a bootstrap of "
    "whole shapes, leaves out 1; these intervals are each method’s own, not corrected for their number, and a "
    "single shape has none."
)


def mark(word: str) -> str:
    """The sign and the word of a change; comparison.css colours those that are significant."""
    kind = word.replace(" ", "-")
    return f"<span class='change {kind}'><span aria-hidden='true'>{SIGNS[word]}</span> {text(word)}</span>"


# The verdict.


def verdict_html(comparison: Comparison) -> str:
    parts = [f"<p class='lead' id='verdict'>{text(headline(comparison))}</p>", _warnings(comparison)]
    if comparison.same_machine:
        for change in ("slower", "faster"):
            title, none = f"{SIGNS[change]} {change.capitalize()} in B", f"No method is {change} in B as a whole."
            parts.append(_finding(change, title, _method_sentences(comparison, change), none))
        title, none = f"{SIGNS['not told apart']} Not told apart", "Every method with times differs."
        parts.append(_finding("apart", title, _method_sentences(comparison, "not told apart", "not judged"), none))
    parts += [_status_finding(comparison), _error_finding(comparison)]
    notes = [NOT_EQUAL, HOW_JUDGED] if comparison.same_machine else [NOT_EQUAL]
    parts.append(_method_table(comparison))
    return "\n".join(part for part in [*parts, notes_of(notes)] if part)


def headline(comparison: Comparison) -> str:
    """The whole in one or two sentences of plain text."""
    counts = Counter(pair.change for pair in comparison.pairs)
    judged = sum(pair.judged for pair in comparison.pairs)
    said = f"{count_of(len(comparison.pairs), 'run')} in both"
    if comparison.same_run:
        return (
            f"A and B are the same measurements: {said}, every repetition the same. So this shows what no difference "
            "looks like."
        )
    if judged == 0:
        said += "; the time of none could be judged, for want of repetitions."
    elif comparison.same_machine:
        said += (
            f", {judged} of them judged: in B {counts['slower']} slower, {counts['faster']} faster, "
            f"{counts['not told apart']} not told apart."
        )
    else:
        differ = counts["slower"] + counts["faster"]
        said += (
            f". The times are not from one machine, so nothing is said to have become faster or slower: in {differ} of "
            f"{judged} runs judged they differ."
        )
    now = [
        f"{count_of(counts[change], 'run')} {change if counts[change] == 1 else change[:-1]}"
        for change in ("now fails", "now works")
        if counts[change]
    ]
    said += f" {sentence_list(now)}." if now else " None fails that did not before."
    errors = [change for pair in comparison.pairs if (change := pair.error_change)]
    if errors:
        grew = sum(change > 0 for change in errors)
        said += f" The error changed in {count_of(len(errors), 'run')}: {grew} larger, {len(errors) - grew} smaller."
    elif any(pair.error_change is not None for pair in comparison.pairs):
        said += " No error changed."
    return said


def _machine_warning(comparison: Comparison) -> str:
    a, b = (", ".join(sorted(machines)) for machines in comparison.machines)
    return (
        f"The machines differ (A: {a}; B: {b}). A ratio of times across machines compares the machines, not the methods: no "
        "time is judged as a regression, and none is coloured. Errors can be compared."
    )


def _warnings(comparison: Comparison) -> str:
    said = [] if comparison.same_machine else [_machine_warning(comparison)]
    total = len(comparison.pairs)
    for key, what in (
        ("same_points", "other points"),
        ("same_parameters", "other parameters"),
        ("same_version", "another version of the method"),
    ):
        differ = [pair for pair in comparison.pairs if not pair.told[key]]
        if differ:
            methods = sentence_list(sorted({label([pair.experiment], pair.a.series) for pair in differ}))
            said.append(
                f"{len(differ)} of {count_of(total, 'run')} had {what} in B ({methods}), which the times and errors "
                "show as well."
            )
    for side, names in (("A", comparison.only_a), ("B", comparison.only_b)):
        if names:
            said.append(
                f"{count_of(len(names), 'run')} {'is' if len(names) == 1 else 'are'} only in {side} and not compared; "
                "the last section names them."
            )
    if comparison.same_machine and not comparison.same_run:
        said.append(SAME_PROGRAM)
    return list_of(said, " class='warnings' id='warnings'")


def _method_sentences(comparison: Comparison, *changes: str) -> list[tuple[str, str]]:
    methods = [one for change in changes for one in comparison.methods if one.ratio is not None and one.change == change]
    return [(one.label, _method_sentence(one)) for one in methods]


def _method_sentence(one: MethodChange) -> str:
    said = f"{number(one.ratio)} times the time of A"
    if one.interval:
        said += f" (95 %: {_interval(one)})"
    else:
        said += " (a single shape, so no interval and no verdict on the method)"
    said += f", median of {count_of(one.told['pairs'], 'run')}; "
    if one.judged == 0:
        return said + "no single run could be judged, for want of repetitions."
    return said + f"{one.told['slower']} slower and {one.told['faster']} faster of {one.judged} judged."


def _interval(one: MethodChange) -> str:
    return f"{number(one.interval[0])} to {number(one.interval[1])}" if one.interval else "–"


def _finding(identity: str, title: str, findings: Sequence[tuple[str, str]], empty: str, more: str = "") -> str:
    items = "".join(f"<li><b>{text(where).replace('/', '/<wbr>')}:</b> {text(said)}</li>" for where, said in findings)
    body = f"<ul>{items}</ul>{more}" if findings else f"<p>{text(empty)}</p>"
    return finding(f"verdict-{identity}", title, body, "finding" if findings else "finding empty")


def _status_finding(comparison: Comparison) -> str:
    changed = comparison.having("now fails", "now works")
    failing = len(comparison.having("fails in both"))
    both = f" {count_of(failing, 'run')} without a result in both." if failing else ""
    found = [(f"{SIGNS[pair.change]}\u00a0{pair.a.name}", _status_sentence(pair)) for pair in changed[:MOST_NAMED]]
    return _finding(
        "statuses",
        "✕ Now fails, ✓ now works",
        found,
        f"No run fails that worked, and none works that failed.{both}",
        _rest(len(changed)) + (f"<p class='muted'>{text(both.strip())}</p>" if both else ""),
    )


def _status_sentence(pair: Pair) -> str:
    row = pair.b if pair.change == "now fails" else pair.a
    why = f" ({row.detail.rstrip('.')})" if row.detail else ""
    if row.ok:  # its result is not believed, for a reason that the table of the run gives
        return f"{pair.change}: no result that is believed in {'B' if pair.change == 'now fails' else 'A'}."
    verb = "now" if pair.change == "now fails" else "now works; before:"
    return f"{verb} {STATUS_WORDS.get(row.status, row.status)}{why}."


def _error_finding(comparison: Comparison) -> str:
    changed = sorted((pair for pair in comparison.pairs if pair.error_change), key=lambda pair: -abs(pair.error_change))
    others = sum(pair.other_result and not pair.error_change for pair in comparison.pairs)
    more = f"<p class='muted'>In {count_of(others, 'run')} the result is another, with the same error.</p>" if others else ""
    found = [
        (f"{'▲' if pair.error_change > 0 else '▼'}\u00a0{pair.a.name}", error_sentence(pair)) for pair in changed[:MOST_NAMED]
    ]
    empty = "Every run with an error in both has the same one, to rounding."
    if not any(pair.error_change is not None for pair in comparison.pairs):
        empty = "No run has an error in both."
    return _finding(
        "errors",
        "Errors that changed",
        found,
        empty + (f" In {count_of(others, 'run')} the result is another." if others else ""),
        _rest(len(changed)) + more,
    )


def error_sentence(pair: Pair) -> str:
    a, b = pair.told["l2_a"], pair.told["l2_b"]
    word = "larger" if pair.error_change > 0 else "smaller"
    why = pair.other_inputs
    return (
        f"L2 {word}, {number(100 * a)} % in A, {number(100 * b)} % in B ("
        f"{'+' if b > a else '−'}{number(100 * abs(b - a))} "
        f"percentage points{'; other ' + sentence_list(why) if why else ''})."
    )


def _rest(count: int) -> str:
    left = count - MOST_NAMED
    return f"<p class='muted'>And {left} more, in the table of all runs.</p>" if left > 0 else ""


def _method_table(comparison: Comparison) -> str:
    columns = {"Method (who chose the parameters)": "", "Time B ÷ A": "number", "95 % interval": "number", "Verdict": ""}
    counts = [f"{SIGNS[word]} {word.capitalize()}" for word in map(comparison.word, ("slower", "faster"))]
    columns |= dict.fromkeys(["Runs", "Judged", *counts], "number")
    rows = "".join(
        row_of(columns, _method_cells(one, comparison), f" data-entrant='{text(one.series.key)}'") for one in comparison.methods
    )
    caption = "Time of equal work by method: the median of the ratios of all its runs; below 1, B takes less"
    attributes = " id='method-table' data-testid='method-table'"
    return table_of("Change of every method", columns, rows, attributes, caption)


def _method_cells(one: MethodChange, comparison: Comparison) -> list[object]:
    ratio = "–" if one.ratio is None else number(one.ratio)
    verdict = "no times in both" if one.ratio is None else "not judged: a single shape" if not one.interval else None
    counts = [one.told["pairs"], one.judged, one.told["slower"], one.told["faster"]]
    name = named(one.series.method, text(one.label))
    return [name, ratio, _interval(one), verdict or mark(comparison.word(one.change)), *counts]


# What differs between the runs.


def differences_html(comparison: Comparison) -> str:
    """What differs, in two columns; what does not, behind a heading."""
    facts = _all_facts(comparison)
    differing = [fact for fact in facts if fact[1] != fact[2]]
    same = [fact for fact in facts if fact[1] == fact[2]]
    told = _facts_table("differences-table", "What differs", differing, "Nothing that is recorded differs.")
    both = _facts_table("same-table", "The same in both", same, "Nothing.")
    return told + details(f"The same in both ({len(same)})", both, " id='same-facts'")


def _facts_table(identity: str, title: str, facts: Sequence[tuple[str, str, str]], without: str) -> str:
    if not facts:
        return f"<p>{without}</p>"
    rows = ""
    for name, a, b in facts:
        differs = a != b
        sign = "<span class='differs' title='differs'>≠<span class='hidden'> differs</span></span> " if differs else ""
        kind = " class='always'" if name in ALWAYS_OTHER else ""
        cells = (
            f"<td data-side='A'>{text(a) or '–'}</td><td data-side='B'>{text(b) or '–'}</td>"
            if differs
            else f"<td data-side='A and B' colspan='2'>{text(a) or '–'}</td>"
        )
        rows += f"<tr{kind}><th scope='row'>{sign}{text(name)}</th>{cells}</tr>"
    return (
        f"<table class='facts' id='{identity}'><caption class='hidden'>{text(title)}</caption>"
        "<thead><tr><th scope='col'>What</th>"
        f"<th scope='col'>A, before</th><th scope='col'>B, after</th></tr></thead><tbody>{rows}</tbody></table>"
    )


def _all_facts(comparison: Comparison) -> list[tuple[str, str, str]]:
    """(what, in A, in B)."""

    def both(value: Callable[[Sequence[Experiment]], dict[str, str]]) -> list[tuple[str, str, str]]:
        a, b = value(comparison.a), value(comparison.b)
        return [(name, a.get(name, "not in A"), b.get(name, "not in B")) for name in dict.fromkeys([*a, *b])]

    machines = [", ".join(sorted(one)) or "not recorded" for one in comparison.machines]
    return [
        ("Machine", *machines),
        *both(_environment),
        *both(_versions),
        *both(_parameters),
        *both(_plans),
        *_points(comparison),
    ]


def _joined(values: Sequence[str]) -> str:
    return "; ".join(dict.fromkeys(values))


def _environment(experiments: Sequence[Experiment]) -> dict[str, str]:
    facts = [environment_facts(experiment.report) for experiment in experiments]
    return {
        name: _joined([one[name] for one in facts if name in one])
        for name in dict.fromkeys(key for one in facts for key in one)
    }


def _versions(experiments: Sequence[Experiment]) -> dict[str, str]:
    return {
        f"Version of {method['title']}": method.get("version", "") if method.get("installed") else "not installed"
        for method in methods_of(experiments).values()
    }


def _parameters(experiments: Sequence[Experiment]) -> dict[str, str]:
    """Of every entrant, as the plans have them."""
    found: dict[Series, list[str]] = {}
    for experiment in experiments:
        for entry in experiment.plan.get("methods", []):
            found.setdefault(Series(entry.get("method", ""), entry.get("protocol", "")), []).append(
                entry_parameters(entry, experiment)
            )
    return {f"Parameters of {label(experiments, series)}": _joined(values) for series, values in found.items()}


def _plans(experiments: Sequence[Experiment]) -> dict[str, str]:
    made = {"Experiments": _joined([one.title for one in experiments])}
    for name, key in (("Repetitions", "repetitions"), ("Seed", "seed"), ("Filter", "filter")):
        values = [one.report.get(key) for one in experiments]
        made[name] = _joined(["none" if value in (None, "") else str(value) for value in values])
    for name, key in (("Warm-up", "warmup"), ("Time limit, s", "timeout_s"), ("Memory limit, MiB", "mem_limit_mib")):
        made[name] = _joined([str(one.plan.get(key, "none")) for one in experiments])
    series = {one for experiment in experiments for one in experiment.series()}
    made["Methods"] = ", ".join(sorted(label(experiments, one) for one in series))
    return made


def _points(comparison: Comparison) -> list[tuple[str, str, str]]:
    """The points of every data set that both have, by their hashes."""
    others = [pair for pair in comparison.pairs if not pair.told["same_points"]]
    count = len({tuple(row.raw.get("dataset_sha256", "") for row in (pair.a, pair.b)) for pair in others})
    values = ("–", f"other than in A in {count_of(count, 'case')}") if count else ("the same", "the same")
    said = [("Points of the shared cases", *values)]
    shapes = [
        {dataset["title"]: str(dataset.get("sha256", "")) for experiment in side for dataset in experiment.datasets.values()}
        for side in (comparison.a, comparison.b)
    ]
    for title in dict.fromkeys([*shapes[0], *shapes[1]]):
        a, b = (side.get(title) for side in shapes)
        if a != b:
            said.append((f"Shape {title}", "not in A" if a is None else a[:12], "not in B" if b is None else b[:12]))
    return said


# What only one of them has, and the program's own notes.


def only_html(comparison: Comparison) -> str:
    made = ""
    for side, names in (("A", comparison.only_a), ("B", comparison.only_b)):
        if names:
            items = "".join(f"<li><code>{text(name)}</code></li>" for name in names)
            made += details(f"Only in {side}: {count_of(len(names), 'run')}", f"<ul>{items}</ul>", " class='only'")
    made = made or "<p>Both have the same runs.</p>"
    return made + details("What hullbench compare says", notes_of(comparison.notes))
