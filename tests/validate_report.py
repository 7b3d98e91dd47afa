#!/usr/bin/env python3
"""Validates reports, run lines and plans as plots/records.py does: with an implementation of JSON Schema 2020-12 that is not the
program's own.

    validate_report.py FILE...              every *.json against the report's schema (a plan: the plan's), every line of *.jsonl against the run's
    validate_report.py --broken CASES FILE  FILE is valid, and with each change in CASES it is not

Exit status: 0 valid; 1 a file is not, and its first fault is printed; 2 wrong usage.
"""
import copy
import json
import sys
from pathlib import Path

import jsonschema
import plot_tests  # for what is in plots/

from records import SCHEMAS, RecordError, checked, read_json

RUN = "run.schema.json"
REPORT = "report.schema.json"
PLAN = "../benchmarks/plans/plan.schema.json"
ANY_OBJECT = {"type": "object"}


def check_schemas():
    """What records.py takes on trust."""
    schemas = {name: read_json(SCHEMAS / name, ANY_OBJECT) for name in (RUN, REPORT, PLAN)}
    for schema in schemas.values():
        jsonschema.Draft202012Validator.check_schema(schema)
    # Where it puts the run's schema in.
    assert schemas[REPORT]["properties"]["runs"]["items"] == {"$ref": RUN}


def check_file(path):
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".jsonl":
        is_plan = "cases" in checked(text, ANY_OBJECT, str(path))
        checked(text, PLAN if is_plan else REPORT, str(path))
        return
    for number, line in enumerate(text.splitlines(), 1):
        checked(line, RUN, f"{path}: line {number}")
    if text and not text.endswith("\n"):
        raise RecordError(f"{path}: the last line is cut short")


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


def is_report(document):
    try:
        checked(json.dumps(document, allow_nan=False), REPORT, "")
    except RecordError:
        return False
    return True


def check_broken(cases_file, report_file):
    report = read_json(report_file, REPORT)
    cases = read_json(cases_file, {"type": "array", "minItems": 1})
    taken = [f"{case['fault']} ({case['path']})" for case in cases if is_report(changed(report, case))]
    if taken:
        raise RecordError(f"the schema takes a report with {'; with '.join(taken)}")


def main(arguments):
    is_broken = arguments[:1] == ["--broken"]
    if not arguments or (is_broken and len(arguments) != 3):
        print(__doc__, file=sys.stderr)
        return 2
    check_schemas()
    status = 0
    for name in arguments[2:] if is_broken else arguments:
        try:
            if is_broken:
                check_broken(Path(arguments[1]), Path(name))
            else:
                check_file(Path(name))
            print(f"{name}: valid")
        except (RecordError, OSError, UnicodeDecodeError) as error:
            print(f"error: {error}", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
