"""The parts of the page that need no script: each experiment, comparison with the paper, parameters, environment and notes."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from records import Experiment, Series
from report_common import STATUS_WORDS, count_of, label, number, protocol_words, text
from report_data import BRIEF_METRICS, is_brief, title_of
from report_summary import Ratio, Standing, Summary, failure_sentences, headline_sentences, noise_sentence, span
from report_tables import documents, list_html, table_html, tables_beside

EQUAL_WORK = (
    "Times are of equal work: from the points in memory to a valid multipolygon in memory, the same for every "
    "method. Loading the points, such as the upload to a database, is left out."
)


def summary_html(experiments: Sequence[Experiment], summaries: Sequence[Summary]) -> str:
    standings = f"<details><summary>Standing of every method</summary>{standings_table(summaries)}</details>"
    parts = [_headline(summaries), _failures(summaries), standings]
    notes = [EQUAL_WORK, noise_sentence(experiments), _reading(summaries), _brackets(experiments)]
    return "\n".join(parts) + "<ul class='notes'>" + "".join(f"<li>{text(note)}</li>" for note in notes) + "</ul>"


def _reading(summaries: Sequence[Summary]) -> str:
    said = (
        "A ratio of times is the median over the rounds of a case, in which both were measured right after one another; "
        "of the cases the median is told. A case that only the method failed has the ratio ∞; a time is better only where the "
        "95 % interval of the ratio leaves out 1. The fastest is faster in this sense than every other method; where one of "
        "them has too few repetitions for an interval, as a slow one has, only the medians are compared."
    )
    alone = [one.title for one in summaries if one.without_interval]
    return said + (f" Without an interval, as each time was taken once: {', '.join(alone)}." if alone else "")


def _brackets(experiments: Sequence[Experiment]) -> str:
    told = "; ".join(f"{name}, {words}" for name, words in protocol_words(experiments).items())
    return f"In brackets: who chose a method's parameters. {told[:1].upper()}{told[1:]}."


def _finding(identity: str, title: str, findings: Sequence[tuple[str, str]]) -> str:
    items = "".join(f"<li><b>{text(where)}:</b> {text(said)}</li>" for where, said in findings)
    return f"<div class='finding' id='summary-{identity}'><h3>{text(title)}</h3><ul>{items}</ul></div>"


def _headline(summaries: Sequence[Summary]) -> str:
    findings = [(one.title, said) for one in summaries for said in headline_sentences(one)]
    return _finding("headline", "Beside the fastest method with the same polygons", findings) if findings else ""


def _failures(summaries: Sequence[Summary]) -> str:
    findings = failure_sentences(summaries)
    if not findings:
        return "<div class='finding' id='summary-failures'><h3>Failures</h3><p>Every run has a valid result.</p></div>"
    return _finding("failures", "Failures", findings)


def standings_table(summaries: Sequence[Summary], method: str | None = None) -> str:
    """Of every method in every experiment, or of one; empty where there is none."""
    rows = "".join(
        f"<tbody><tr class='group'><th colspan='7' scope='rowgroup'>{text(one.title)}</th></tr>{told}</tbody>"
        for one in summaries
        if (told := "".join(_standing(one, each) for each in one.standings if method in (None, each.series.method)))
    )
    if not rows:
        return ""
    head = "".join(
        f"<th scope='col'{side}>{title}</th>"
        for title, side in (
            ("Method (who chose the parameters)", ""),
            ("Results", " class='number'"),
            ("Failures", ""),
            ("Fastest in", " class='number'"),
            ("Time ÷ Polylidar’s", " class='number'"),
            ("Most accurate in", " class='number'"),
            ("Error ÷ Polylidar’s", " class='number'"),
        )
    )
    return (
        "<div class='scroll' tabindex='0' role='region' aria-label='Standing'>"
        "<table id='summary-table' data-testid='summary-table'><caption>Beside Polylidar, over the cases that either solved: "
        f"median, and from the least to the largest</caption><thead><tr>{head}</tr></thead>{rows}</table></div>"
    )


def _standing(summary: Summary, one: Standing) -> str:
    failures = ", ".join(f"{count} {STATUS_WORDS.get(status, status)}" for status, count in one.failures.most_common())
    is_core = one is summary.core

    def ratio(value: Ratio | None) -> str:
        if is_core:
            return "<td class='number'>1</td>"
        if value is None:
            return "<td class='number'>–</td>"
        mark = " better" if value.median < 1 and value.lower_in else ""
        said = f"{span(value)}, {count_of(value.cases, 'case')}" if value.cases > 1 else "1 case"
        return f"<td class='number{mark}'>{text(number(value.median))}<small>{text(said)}</small></td>"

    def share(count: int, of: int) -> str:
        return f"<td class='number'>{f'{count} of {of}' if of and one.results else '–'}</td>"

    return (
        f"<tr data-entrant='{text(one.series.key)}' data-experiment='{text(summary.name)}'"
        f"{' class=core' if is_core else ''}>"
        f"<th scope='row'><span class='swatch' data-method='{text(one.series.method)}'></span>{text(one.label)}</th>"
        f"<td class='number'>{len(one.results)} of {one.planned}</td><td>{text(failures) or '–'}</td>"
        f"{share(one.fastest_in, summary.contested)}{ratio(one.time)}"
        f"{share(one.most_accurate_in, summary.compared_errors)}{ratio(one.error)}</tr>"
    )


# Beside the paper.

# Tables that stand in a section of the page with what is beside them.
_DIFFERENCES = "differences"
_PARAMETERS = "parameters"


def paper_html(experiments: Sequence[Experiment], folder: Path) -> str:
    made = ""
    claims = [(experiment, claim) for experiment in experiments for claim in experiment.report["summary"]["claims"]]
    if claims:
        made += _claims(claims)
    made += "".join(map(table_html, tables_beside(documents(experiments, folder), _DIFFERENCES)))
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
    table = (
        "<div class='scroll' tabindex='0' role='region' aria-label='Claims of the paper'><table id='claims'><thead>"
        "<tr><th scope='col'>Claim</th><th scope='col'>Experiment</th><th scope='col' class='number'>Paper</th>"
        "<th scope='col' class='number'>Here</th><th scope='col' class='number'>Equal work</th>"
        f"<th scope='col'>Verdict</th></tr></thead><tbody>{rows}</tbody></table></div>"
    )
    return f"<h3>The paper’s claims beside this run</h3>{table if rows else ''}{said}"


def _verdict(claim: dict[str, Any]) -> str | None:
    """None: not measured."""
    verdict = claim["verdict"]
    return f"{verdict} than the paper’s" if verdict in ("larger", "smaller") else verdict


def _claim(experiment: Experiment, claim: dict[str, Any]) -> str:
    word = _verdict(claim)
    kind = "holds" if word == "confirmed" else "fails"
    return (
        f"<tr data-claim='{text(claim['id'])}'><th scope='row'>{text(claim['claim'])}"
        f"<small>{text(claim['where'])}: {text(claim['detail'])}</small></th><td>{text(experiment.title)}</td>"
        f"<td class='number'>{text(claim['paper'])}</td><td class='number'>{text(claim['ours'])}</td>"
        f"<td class='number'>{text(claim['equal_work'] or '–')}</td>"
        f"<td><span class='verdict {kind}'>{word}</span></td></tr>"
    )


def tables_html(experiments: Sequence[Experiment], folder: Path) -> str:
    """Every table that no other section has, an experiment behind its own heading; empty without any."""
    return "".join(
        f"<details><summary>{text(document['title'])}</summary>"
        f"{''.join(map(table_html, document['tables']))}{_notes(document['notes'])}</details>"
        for document in documents(experiments, folder)
        if not {_DIFFERENCES, _PARAMETERS} & {table["id"] for table in document["tables"]}
    )


def _notes(notes: Sequence[str]) -> str:
    return f"<h3>Notes</h3>{list_html(notes)}" if notes else ""


# Parameters.


def parameters_html(experiments: Sequence[Experiment], folder: Path) -> str:
    """Who chose them, the program's table of them, what they mean and how the experiments were run."""
    said = facts_html({name: text(words) for name, words in protocol_words(experiments).items()})
    tables = "".join(map(table_html, tables_beside(documents(experiments, folder), _PARAMETERS)))
    return f"<h3>Who chose them</h3>{said}" + tables + _described(experiments) + _plans(experiments)


def facts_html(facts: dict[str, str], identity: str = "") -> str:
    """Names, and what is to be said of them as HTML."""
    rows = "".join(f"<div><dt>{text(name)}</dt><dd>{told}</dd></div>" for name, told in facts.items())
    named = f" id='{identity}'" if identity else ""
    return f"<dl{named}>{rows}</dl>"


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


PARAMETER_HEAD = ("Unit", "Range", "Default", "Meaning")


def parameter_cells(one: dict[str, Any]) -> str:
    """What PARAMETER_HEAD names."""
    low, high = one["minimum"], one["maximum"]
    limits = f"{'' if low is None else number(low)} to {'no limit' if high is None else number(high)}"
    default = parameter_value(one["default"], {}) if "default" in one else "required"
    return (
        f"<td>{text(one['unit'])}</td><td>{text(limits)}</td><td>{text(default)}</td>"
        f"<td class='prose'>{text(one['description'])}</td>"
    )


def _described(experiments: Sequence[Experiment]) -> str:
    rows = "".join(
        f"<tr><th scope='row'>{text(method['title'])}</th><td>{text(one['name'])}</td>{parameter_cells(one)}</tr>"
        for method in methods_of(experiments).values()
        for one in method["parameters"]
    )
    return _details("What the parameters mean", ("Method", "Parameter", *PARAMETER_HEAD), rows)


def _plans(experiments: Sequence[Experiment]) -> str:
    rows = ""
    for one in experiments:
        plan = one.plan
        rows += (
            f"<tr><th scope='row'>{text(one.title)}</th><td>{text(plan.get('paper', '–'))}</td>"
            f"<td class='number'>{text(one.report['repetitions'])}</td>"
            f"<td class='number'>{text(plan.get('warmup', ''))}</td><td class='number'>{text(plan.get('timeout_s', ''))}"
            f"</td><td class='number'>{text(plan.get('mem_limit_mib', ''))}</td>"
            f"<td class='number'>{text(one.report['seed'])}</td>"
            f"<td>{text(one.report['filter'] or 'none')}</td></tr>"
        )
    return _details(
        "How the experiments were run",
        ("Experiment", "In the paper", "Repetitions", "Warm-up", "Time limit, s", "Memory limit, MiB", "Seed", "Filter"),
        rows,
    )


def _details(title: str, head: Sequence[str], rows: str) -> str:
    return f"<details><summary>{text(title)}</summary>{table_of(title, head, rows)}</details>"


def table_of(title: str, head: Sequence[str], rows: str, numbers: int = 0) -> str:
    """A table that can be scrolled; the last columns, so many, are numbers."""
    words = len(head) - numbers
    top = "".join(
        f"<th scope='col'{' class=number' if place >= words else ''}>{text(one)}</th>" for place, one in enumerate(head)
    )
    return (
        f"<div class='scroll' tabindex='0' role='region' aria-label='{text(title)}'><table><thead><tr>{top}</tr></thead>"
        f"<tbody>{rows}</tbody></table></div>"
    )


# Environment and versions.


def environment_html(experiments: Sequence[Experiment]) -> str:
    """One value where all experiments agree, else one an experiment."""
    facts: dict[str, dict[str, str]] = {}
    for experiment in experiments:
        for name, value in environment_facts(experiment.report).items():
            facts.setdefault(name, {})[experiment.title] = value
    said = {}
    for name, values in facts.items():
        several = set(values.values())
        said[name] = (
            text(next(iter(several)))
            if len(several) == 1
            else "<br>".join(f"{text(value)} <small>{text(where)}</small>" for where, value in values.items())
        )
    return facts_html(said, "environment-facts") + _noise(experiments) + _versions(experiments)


def _noise(experiments: Sequence[Experiment]) -> str:
    rows = ""
    for experiment in experiments:
        told = experiment.report["summary"].get("noise")
        count, middle, most, verdict = 0, "–", "–", "nothing can be said"
        if told:
            count, middle, most = told["rows"], *(f"{100 * told[key]:.1f} %" for key in ("median_spread", "ninth_decile"))
            kind, word = ("fails", "noisy") if told["noisy"] else ("holds", "steady")
            verdict = f"<span class='verdict {kind}'>{word}</span>"
        cells = "".join(f"<td class='number'>{cell}</td>" for cell in (count, middle, most))
        rows += f"<tr><th scope='row'>{text(experiment.title)}</th>{cells}<td>{verdict}</td></tr>"
    return (
        "<h3>Noise</h3><p class='muted'>The spread of a run is the median absolute deviation of its times over their "
        "median.</p><div class='scroll' tabindex='0' role='region' "
        "aria-label='Noise'><table id='noise'><thead><tr><th scope='col'>Experiment</th><th scope='col' "
        "class='number'>Runs with 3 repetitions or more</th><th scope='col' class='number'>Spread of the median run</th>"
        "<th scope='col' class='number'>Of nine in ten, at most</th><th scope='col'>Verdict</th></tr></thead>"
        f"<tbody>{rows}</tbody></table></div>"
    )


def environment_facts(report: dict[str, Any]) -> dict[str, str]:
    environment, tool = report["environment"], report["tool"]
    cpu, compiler, load = environment["cpu"], environment["compiler"], environment["load_average"]

    def known(value: Any) -> str:
        return "unknown" if value is None else {True: "yes", False: "no"}.get(value, str(value))

    facts = {
        "Processor": f"{cpu['model']}, {cpu['logical_cores']} logical cores, {cpu['architecture']}",
        "Virtual machine": known(cpu["virtualised"]),
        "Boost": known(cpu["boost"]),
        "Governors": ", ".join(cpu["governors"] or []) or "unknown",
        "Memory": f"{number(environment['memory_bytes'] / 2**30)} GiB",
        "Load before the run": ", ".join(map(number, load)) + " (1, 5, 15 minutes)" if load else "unknown",
        "System": f"{known(environment['os'])}; {environment['kernel'] or 'unknown kernel'}",
        "Address randomisation": known(environment["aslr"]),
        "Huge pages": ", ".join(f"{name}: {known(value)}" for name, value in environment.get("huge_pages", {}).items())
        or "asked for by Polylidar alone",
        "Temperature": known(environment.get("temperature_celsius")),
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
        facts["Merged from"] = ", ".join(f"shard {one['shard']} of {one['created']}" for one in report["merged"])
    return facts


def abilities(method: dict[str, Any]) -> str:
    return ", ".join(name.replace("_", " ") for name, has in method["capabilities"].items() if has) or "–"


def version_html(method: dict[str, Any]) -> str:
    """Or why it is not installed, and what to do about it."""
    if method["installed"]:
        return text(method["version"])
    missing = f"<small>{text(method['detail'])}; {text(method['remedy'])}</small>"
    return f"<span class='verdict fails'>not installed</span>{missing}"


def _versions(experiments: Sequence[Experiment]) -> str:
    rows = "".join(
        f"<tr><th scope='row'><span class='swatch' data-method='{text(method['name'])}'></span>"
        f"{text(method['title'])}</th><td>{version_html(method)}</td><td>{text(method['native_output'])}</td>"
        f"<td>{text(abilities(method))}</td><td>{text(method['licence'])}</td>"
        f"<td class='prose'>{text(method['citation'])}</td></tr>"
        for method in methods_of(experiments).values()
    )
    return (
        "<h3>Methods and versions</h3><div class='scroll' tabindex='0' role='region' aria-label='Methods'>"
        "<table id='methods'><thead><tr><th scope='col'>Method</th><th scope='col'>Version</th>"
        "<th scope='col'>The library returns</th><th scope='col'>Can do</th><th scope='col'>Licence</th>"
        f"<th scope='col'>Source</th></tr></thead><tbody>{rows}</tbody></table></div>"
    )


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
    items = "".join(f"<li>{text(note)}</li>" for note in said)
    notes = f"<ul class='notes'>{items}</ul>" if items else "<p>The records have no notes.</p>"
    datasets = {name: dataset for experiment in experiments for name, dataset in experiment.datasets.items()}
    rows = "".join(
        f"<tr><th scope='row'>{text(one['title'])}</th><td class='prose'>{text(one['source'])}</td>"
        f"<td class='prose'>{text(one['licence'])}</td></tr>"
        for one in datasets.values()
    )
    return notes + _details("Sources and licences of the shapes", ("Shape", "Source", "Licence"), rows)
