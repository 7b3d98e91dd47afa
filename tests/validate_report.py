#!/usr/bin/env python3
"""Validates reports, run lines and plans with an implementation of JSON Schema 2020-12 that is not the program's own.

    validate_report.py FILE...              every *.json against the report's schema (a plan: the plan's), every line of *.jsonl against the run's
    validate_report.py --broken CASES FILE  FILE is valid, and with each change in CASES it is not

Exit status: 0 valid; 1 a fault was found, printed with its place as a JSON pointer; 2 a file cannot be read.
"""
import copy
import json
import pathlib
import sys

import jsonschema

SCHEMAS = pathlib.Path(__file__).resolve().parent.parent / "results"
PLAN_SCHEMA = "../benchmarks/plans/plan.schema.json"


def strict_json(text):
    """NaN and Infinity, which Python's reader takes, are no JSON."""

    def refuse(constant):
        raise ValueError(f"{constant} is not JSON")

    return json.loads(text, parse_constant=refuse)


def read_schema(name):
    schema = strict_json((SCHEMAS / name).read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return schema


def run_validator():
    return jsonschema.Draft202012Validator(read_schema("run.schema.json"))


def report_validator():
    """Of the report's schema with the run's put in where it refers to it, so that nothing has to be fetched."""
    schema = read_schema("report.schema.json")
    assert schema["properties"]["runs"]["items"] == {"$ref": "run.schema.json"}
    schema["properties"]["runs"]["items"] = read_schema("run.schema.json")
    return jsonschema.Draft202012Validator(schema)


def faults(validator, document):
    errors = validator.iter_errors(document)
    return [f"/{'/'.join(str(step) for step in error.absolute_path)}: {error.message[:200]}" for error in errors]


def faults_of_file(path):
    text = path.read_text()
    if path.suffix != ".jsonl":
        document = strict_json(text)
        if "cases" in document:
            return faults(jsonschema.Draft202012Validator(read_schema(PLAN_SCHEMA)), document)
        return faults(report_validator(), document)
    validator = run_validator()
    found = [
        f"line {number}: {fault}"
        for number, line in enumerate(text.splitlines(), 1)
        for fault in faults(validator, strict_json(line))
    ]
    return found if text.endswith("\n") or not text else found + ["the last line is cut short"]


def changed(document, case):
    """`document` with the member at case["path"] set to case["value"], or taken away if there is no value."""
    result = copy.deepcopy(document)
    *way, last = [int(step) if step.isdigit() else step for step in case["path"].split("/")[1:]]
    place = result
    for step in way:
        place = place[step]
    if "value" in case:
        place[last] = case["value"]
    else:
        del place[last]
    return result


def check_broken(cases_file, report_file):
    validator = report_validator()
    report = strict_json(report_file.read_text())
    cases = strict_json(cases_file.read_text())
    found = faults(validator, report)
    if not cases:
        found.append("there is no broken case to try")
    for case in cases:
        if validator.is_valid(changed(report, case)):
            found.append(f"{case['path']}: the schema takes a report with this fault: {case['fault']}")
    return found


def main(arguments):
    if not arguments or (arguments[0] == "--broken" and len(arguments) != 3):
        print(__doc__, file=sys.stderr)
        return 2
    status = 0
    try:
        if arguments[0] == "--broken":
            results = [(arguments[2], check_broken(*map(pathlib.Path, arguments[1:])))]
        else:
            results = [(argument, faults_of_file(pathlib.Path(argument))) for argument in arguments]
    except (OSError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    for name, found in results:
        for fault in found:
            print(f"{name}: {fault}", file=sys.stderr)
            status = 1
        if not found:
            print(f"{name}: valid")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
