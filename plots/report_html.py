"""The parts of the page that need no script: each experiment, comparison with the paper, parameters, environment and notes."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from markup import Columns, details, facts_of, finding, named, notes_of, row_of, table_of
from records import Experiment, Series
from report_common import STATUS_WORDS, count_of, label, number, protocol_words, text
from report_data import BRIEF_METRICS, is_brief, title_of
from report_summary import Ratio, Standing, Summary, failure_sentences, headline_sentences, mixture_sentence, noise_sentence
from report_tables import documents, table_html, tables_called

EQUAL_WORK = (
    "Times are of equal work: from the points in memory to a valid multipolygon in memory, the same for every "
    "method. Loading the points, such as the upload to a database, is left out."
)


def summary_html(experiments: Sequence[Experiment], summaries: Sequence[Summary]) -> str:
    standings = details("Standing of every method", standings_table(summaries))
    of_times = filter(None, [EQUAL_WORK, noise_sentence(experiments), mixture_sentence(experiments)])
    notes = [*of_times, _reading(summaries), _brackets(experiments)]
    return "\n".join([_headline(summaries), _failures(summaries), standings]) + notes_of(notes)


def _reading(summaries: Sequence[Summary]) -> str:
    said = (
        "A ratio of times is the median over the rounds of a case, in which both were measured right after one another; "
        "of the cases the median is told. A case that only the method failed has the ratio ∞. In a case a method is faster "
        "where the 95 % interval of the ratios of all its times to all of the other’s leaves out 1, or, with too few repetitions for an interval, where its longest "
        "time is at most a tenth of the other’s shortest. A ratio is in bold where it is below 1 and the method is faster "
        "(or more accurate) in one case at least, or alone solves one. The fastest of a case is faster than every other "
        "method; where none is, the first ones are not distinguishable."
    )
    alone = [one.experiment.title for one in summaries if one.without_interval]
    return said + (f" Without an interval, as each time was taken once: {', '.join(alone)}." if alone else "")


def _brackets(experiments: Sequence[Experiment]) -> str:
    told = "; ".join(f"{name}, {words}" for name, words in protocol_words(experiments).items())
    return f"In brackets: who chose a method's parameters. {told[:1].upper()}{told[1:]}."


def _headline(summaries: Sequence[Summary]) -> str:
    findings = [(one.experiment.title, said) for one in summaries for said in headline_sentences(one)]
    title = "Beside the fastest method with the same polygons"
    return finding("summary-headline", title, _sentences(findings)) if findings else ""


def _failures(summaries: Sequence[Summary]) -> str:
    findings = failure_sentences(summaries)
    said = _sentences(findings) if findings else "<p>Every run has a valid result.</p>"
    return finding("summary-failures", "Failures", said)


def _sentences(findings: Sequence[tuple[str, str]]) -> str:
    return f"<ul>{''.join(f'<li><b>{text(where)}:</b> {text(said)}</li>' for where, said in findings)}</ul>"


_STANDING = {
    "Method (who chose the parameters)": "",
    "Results": "number",
    "Failures": "",
    "Fastest in": "number",
    "Time ÷ Polylidar’s": "number",
    "Most accurate in": "number",
    "Error ÷ Polylidar’s": "number",
}


def standings_table(summaries: Sequence[Summary], method: str | None = None) -> str:
    """Of every method in every experiment, or of one; empty where there is none."""
    rows = "".join(
        f"<tbody><tr class='group'><th colspan='{len(_STANDING)}' scope='rowgroup'>{text(one.experiment.title)}</th></tr>{told}</tbody>"
        for one in summaries
        if (told := "".join(_standing(one, each) for each in one.standings if method in (None, each.series.method)))
    )
    caption = "Beside Polylidar, over the cases that either solved: median, and from the least to the largest"
    attributes = " id='summary-table' data-testid='summary-table'"
    return table_of("Standing", _STANDING, rows, attributes, caption) if rows else ""


def _standing(summary: Summary, one: Standing) -> str:
    failures = ", ".join(f"{count} {STATUS_WORDS.get(status, status)}" for status, count in one.failures.most_common())
    is_core = one is summary.core

    def ratio(value: Ratio | None) -> str:
        if is_core or value is None:
            return "1" if is_core else "–"
        mark = " better" if value.median < 1 and value.lower_in else ""
        better = "<span class='hidden'> better</span>" if mark else ""
        several = f"from {number(value.low)} to {number(value.high)}, {count_of(value.cases, 'case')}"
        said = several if value.cases > 1 else "1 case"
        return f"<td class='number{mark}'>{text(number(value.median))}{better}<small>{text(said)}</small></td>"

    def share(count: int, of: int) -> str:
        return f"{count} of {of}" if of and one.results else "–"

    attributes = f" data-entrant='{text(one.series.key)}' data-experiment='{text(summary.experiment.name)}'"
    cells = [
        named(one.series.method, text(one.label)),
        f"{len(one.results)} of {one.planned}",
        text(failures) or "–",
        share(one.fastest_in, summary.contested),
        ratio(one.time),
        share(one.most_accurate_in, summary.compared_errors),
        ratio(one.error),
    ]
    return row_of(_STANDING, cells, attributes + (" class='core'" if is_core else ""))


# Beside the paper.

# Tables that stand in a section of the page with what is beside them.
_DIFFERENCES = "differences"
_PARAMETERS = "parameters"


def paper_html(experiments: Sequence[Experiment], folder: Path) -> str:
    claims = [(experiment, claim) for experiment in experiments for claim in experiment.report["summary"]["claims"]]
    made = _claims(claims) if claims else ""
    made += "".join(map(table_html, tables_called(documents(experiments, folder), _DIFFERENCES)))
    return made or "<p>The records compare nothing with the paper.</p>"


def _claims(claims: Sequence[tuple[Experiment, dict[str, Any]]]) -> str:
    """Each claim for every experiment that has the cases for it; those that none has are named."""
    by_id: dict[str, list[tuple[Experiment, dict[str, Any]]]] = {}
    for experiment, claim in claims:
        by_id.setdefault(claim["id"], []).append((experiment, claim))
    rows, unmeasured = "", []
    for entries in by_id.values():
        measured = [(experiment, claim) for experiment, claim in entries if _verdict(claim) is not None]
        rows += "".join(_claim(experiment, claim) for experiment, claim in measured)
        if not measured:
            unmeasured.append(entries[0][1]["claim"])
    said = f"<p class='muted'>Not measured in this run: {text('; '.join(unmeasured))}.</p>" if unmeasured else ""
    table = table_of("Claims of the paper", _CLAIM, rows, " id='claims'") if rows else ""
    return f"<h3>The paper’s claims beside this run</h3>{table}{said}"


_CLAIM = {"Claim": "", "Experiment": "", "Paper": "number", "Here": "number", "Equal work": "number", "Verdict": ""}


def _verdict(claim: dict[str, Any]) -> str | None:
    """None: not measured."""
    verdict = claim["verdict"]
    return f"{verdict} than the paper’s" if verdict in ("larger", "smaller") else verdict


def _claim(experiment: Experiment, claim: dict[str, Any]) -> str:
    word = _verdict(claim)
    kind = {"confirmed": "holds", "undecided": "open"}.get(word, "fails")
    paper, ours, equal_work = (text(claim[key] or "–") for key in ("paper", "ours", "equal_work"))
    what = f"{text(claim['claim'])}<small>{text(claim['where'])}: {text(claim['detail'])}</small>"
    cells = [what, text(experiment.title), paper, ours, equal_work, f"<span class='verdict {kind}'>{word}</span>"]
    return row_of(_CLAIM, cells, f" data-claim='{text(claim['id'])}'")


def tables_html(experiments: Sequence[Experiment], folder: Path) -> str:
    """Every table that no other section has, an experiment behind its own heading; empty without any."""
    return "".join(
        details(document["title"], "".join(map(table_html, document["tables"])) + _notes(document["notes"]))
        for document in documents(experiments, folder)
        if not {_DIFFERENCES, _PARAMETERS} & {table["id"] for table in document["tables"]}
    )


def _notes(notes: Sequence[str]) -> str:
    return f"<h3>Notes</h3>{notes_of(notes)}" if notes else ""


# Parameters.


def parameters_html(experiments: Sequence[Experiment], folder: Path) -> str:
    """Who chose them, the program's table of them, what they mean and how the experiments were run."""
    said = facts_of({name: text(words) for name, words in protocol_words(experiments).items()})
    tables = "".join(map(table_html, tables_called(documents(experiments, folder), _PARAMETERS)))
    return f"<h3>Who chose them</h3>{said}" + tables + _described(experiments) + _plans(experiments)


def parameter_value(value: Any, rules: dict[str, str]) -> str:
    """As a plan has it, a rule with its formula."""
    if isinstance(value, dict):
        return rules.get(value.get("rule", ""), json.dumps(value, ensure_ascii=False))
    return "no limit" if value is None else f"{value:g}"


def entry_parameters(entry: dict[str, Any], experiment: Experiment) -> str:
    """What the plan gives a method."""
    rules = experiment.report.get("rules", {})
    given = entry.get("parameters", {})
    return ", ".join(f"{name} = {parameter_value(value, rules)}" for name, value in given.items()) or "none given"


def methods_of(experiments: Sequence[Experiment]) -> dict[str, dict[str, Any]]:
    """By name; where experiments differ, from the first in which it is installed."""
    found: dict[str, dict[str, Any]] = {}
    for experiment in experiments:
        for name, method in experiment.methods.items():
            if name not in found or not found[name]["installed"]:
                found[name] = method
    return found


PARAMETER: Columns = {"Unit": "", "Range": "", "Default": "", "Meaning": "prose"}


def parameter_cells(one: dict[str, Any]) -> list[str]:
    """In the columns PARAMETER."""
    low, high = one["minimum"], one["maximum"]
    limits = f"{'' if low is None else number(low)} to {'no limit' if high is None else number(high)}"
    default = parameter_value(one["default"], {}) if "default" in one else "required"
    return [text(value) for value in (one["unit"], limits, default, one["description"])]


def _described(experiments: Sequence[Experiment]) -> str:
    rows = [
        [text(method["title"]), text(one["name"]), *parameter_cells(one)]
        for method in methods_of(experiments).values()
        for one in method["parameters"]
    ]
    return _details("What the parameters mean", {"Method": "", "Parameter": "", **PARAMETER}, rows)


_PLAN = {
    **dict.fromkeys(("Experiment", "In the paper"), ""),
    **dict.fromkeys(("Repetitions", "Warm-up", "Time limit, s", "Memory limit, MiB", "Seed"), "number"),
    "Filter": "",
}


def _plans(experiments: Sequence[Experiment]) -> str:
    rows = []
    for one in experiments:
        plan, report = one.plan, one.report
        limits = [plan.get(name, "") for name in ("warmup", "timeout_s", "mem_limit_mib")]
        how = [report["repetitions"], *limits, report["seed"], report["filter"] or "none"]
        rows.append(list(map(text, [one.title, plan.get("paper", "–"), *how])))
    return _details("How the experiments were run", _PLAN, rows)


def _details(title: str, columns: Columns, rows: Sequence[Sequence[str]]) -> str:
    return details(title, table_of(title, columns, rows))


# Environment and versions.


def environment_html(experiments: Sequence[Experiment]) -> str:
    """One value where all experiments agree, else one an experiment."""
    facts: dict[str, dict[str, str]] = {}
    for experiment in experiments:
        for name, value in environment_facts(experiment.report).items():
            facts.setdefault(name, {})[experiment.title] = value
    said = {}
    for name, values in facts.items():
        told = [f"{text(value)} <small>{text(where)}</small>" for where, value in values.items()]
        first, *others = set(values.values())
        said[name] = "<br>".join(told) if others or len(values) < len(experiments) else text(first)
    return facts_of(said, "environment-facts") + _noise(experiments) + _versions(experiments)


_SPREADS = ("Runs with 3 repetitions or more", "Spread of the median run", "Of nine in ten, at most")
_NOISE = {"Experiment": "", **dict.fromkeys(_SPREADS, "number"), "Verdict": ""}


def _noise(experiments: Sequence[Experiment]) -> str:
    rows = []
    for experiment in experiments:
        told = experiment.report["summary"].get("noise")
        cells = [0, "–", "–", "nothing can be said"]
        if told:
            kind, word = ("fails", "noisy") if told["noisy"] else ("holds", "steady")
            spreads = (f"{100 * told[key]:.1f} %" for key in ("median_spread", "ninth_decile"))
            cells = [told["rows"], *spreads, f"<span class='verdict {kind}'>{word}</span>"]
        rows.append([text(experiment.title), *cells])
    said = "The spread of a run is the median absolute deviation of its times over their median."
    return f"<h3>Noise</h3><p class='muted'>{said}</p>" + table_of("Noise", _NOISE, rows, " id='noise'")


def environment_facts(report: dict[str, Any]) -> dict[str, str]:
    environment, tool = report["environment"], report["tool"]
    cpu, compiler, load = environment["cpu"], environment["compiler"], environment["load_average"]

    def known(value: Any) -> str:
        if isinstance(value, bool):
            return "yes" if value else "no"
        return "unknown" if value is None else str(value)

    facts = {
        "Processor": f"{cpu['model']}, {cpu['logical_cores']} logical cores, {cpu['architecture']}",
        "Virtual machine": known(cpu["virtualised"]),
        "Boost": known(cpu["boost"]),
        "Governors": ", ".join(cpu["governors"] or []) or "unknown",
        "Memory": f"{number(environment['memory_bytes'] / 2**30)} GiB",
        "Load before the run": ", ".join(map(number, load)) + " (1, 5, 15 minutes)" if load else "unknown",
        "System": f"{known(environment['os'])}; {environment['kernel'] or 'unknown kernel'}",
        "Address randomisation": known({0: "off", 1: "on but for the heap", 2: "on"}.get(environment["aslr"])),
        "Huge pages": ", ".join(f"{name}: {known(value)}" for name, value in environment.get("huge_pages", {}).items())
        or "asked for by Polylidar alone",
        "Temperature, °C": known(environment.get("temperature_celsius")),
        "Compiler": f"{compiler['id']} {compiler['version']}, {compiler['build_type']}, {compiler['flags']}; "
        f"{compiler['statement']}",
        "Libraries": ", ".join(f"{name} {value}" for name, value in environment["libraries"].items()),
        "Program": f"{tool['name']} {tool['version']}, commit {known(tool['commit'])}"
        + (" with uncommitted changes" if tool["dirty"] else ""),
        "Begun": report["created"],
    }
    if report.get("resumed"):
        facts["Gone on with"] = ", ".join(report["resumed"])
    if report.get("merged"):
        parts = [(f"shard {one['shard']}" if one["shard"] else "a run", one["created"]) for one in report["merged"]]
        facts["Merged from"] = ", ".join(f"{what} of {when}" for what, when in parts)
    return facts


def abilities(method: dict[str, Any]) -> str:
    return ", ".join(name.replace("_", " ") for name, has in method["capabilities"].items() if has) or "–"


def version_html(method: dict[str, Any]) -> str:
    """Or why it is not installed, and what to do about it."""
    if method["installed"]:
        return text(method["version"])
    missing = f"<small>{text(method['detail'])}; {text(method['remedy'])}</small>"
    return f"<span class='verdict fails'>not installed</span>{missing}"


_VERSION = {"Method": "", "Version": "", "The library returns": "", "Can do": "", "Licence": "", "Source": "prose"}


def _versions(experiments: Sequence[Experiment]) -> str:
    rows = []
    for method in methods_of(experiments).values():
        facts = (method["native_output"], abilities(method), method["licence"], method["citation"])
        rows.append([named(method["name"], text(method["title"])), version_html(method), *map(text, facts)])
    return "<h3>Methods and versions</h3>" + table_of("Methods", _VERSION, rows, " id='methods'")


# Notes and data sets.


def notes_html(experiments: Sequence[Experiment]) -> str:
    said: dict[str, None] = {}
    for experiment in experiments:
        for note in [*experiment.plan.get("notes", []), *experiment.report["notes"]]:
            said[str(note)] = None
        for entry in experiment.plan.get("methods", []):
            if entry.get("note"):
                name = label(experiments, Series(entry.get("method", ""), entry.get("protocol", "")))
                said[f"{name}: {entry['note']}"] = None
    for experiment in filter(is_brief, experiments):
        titles = ", ".join(title_of(name) for name in BRIEF_METRICS)
        said[
            f"{experiment.title}: of its {len(experiment.rows)} runs this page has these metrics: {titles}. All are in its records."
        ] = None
    notes = notes_of(said) or "<p>The records have no notes.</p>"
    datasets = {name: dataset for experiment in experiments for name, dataset in experiment.datasets.items()}
    rows = [[text(one[key]) for key in ("title", "source", "licence")] for one in datasets.values()]
    return notes + _details("Sources and licences of the shapes", {"Shape": "", "Source": "prose", "Licence": "prose"}, rows)
