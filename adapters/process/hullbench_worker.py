"""The worker's side of hullbench's protocol (PROTOCOL.md) for methods in Python.

    import hullbench_worker  # first: what cannot be imported after it is reported as not installed

    def run(points, alpha):   # points: numpy float64 (n, 2), finite; parameters by name, complete, float
        ...                   # the method; this is timed as "run"

    hullbench_worker.serve(version="1.0", run=run)

`run` returns polygons: a list of [shell, hole, ...], each ring a sequence of (x, y) in either direction, closed or not.
A method whose library has types of its own gives two more functions: `load(points)` makes the library's type of the
points, off the headline time, and `run` gets what it returns; `extract(result)` makes polygons of what `run` returned
and is timed as "extract". Raise `Unsupported` for what the method cannot do (too few points, say).
"""

import gc
import json
import os
import struct
import sys
import time

PROTOCOL = 1


class Unsupported(Exception):
    """The method cannot do what was asked; it is not broken."""


# What is printed must not get into the protocol: standard output becomes standard error.
_replies = os.fdopen(os.dup(1), "w", encoding="utf-8")
os.dup2(2, 1)


def _reply(message):
    _replies.write(json.dumps(message) + "\n")
    _replies.flush()


def _fail(kind, message):
    _reply({"error": {"kind": kind, "message": " ".join(str(message).split())[:1000] or kind}})


def _report_missing_module(kind, error, trace):
    if issubclass(kind, ImportError) and sys.stdin.readline():
        _fail("not_installed", f"{error}, looked for by {sys.executable}")
    else:
        sys.__excepthook__(kind, error, trace)


sys.excepthook = _report_missing_module

import numpy  # after the hook, which tells the harness when it is missing


def _timed(function, *arguments, **parameters):
    begin = time.perf_counter_ns()
    result = function(*arguments, **parameters)
    return result, time.perf_counter_ns() - begin


# Containers that are there anew since the last collection. Fewer are left, as a run of 1 ms takes 3 % longer right after a
# collection.
_MOST_GARBAGE = 10_000


def _collect_garbage():
    """What earlier runs left in cycles; the rest was freed at once."""
    if gc.get_count()[0] > _MOST_GARBAGE:
        gc.collect()


def _read_points(request):
    points = numpy.fromfile(request["points"], dtype="<f8")
    if points.size != 2 * request["n"]:
        raise ValueError(f"{request['points']} does not hold {request['n']} points")
    finite = numpy.isfinite(points)
    if not finite.all():
        raise ValueError(f"point {int(numpy.argmin(finite)) // 2} is not finite")
    return points.reshape(-1, 2)


def _ring_to_wkb(ring):
    points = [(float(x), float(y)) for x, y in ring]
    if points and points[0] != points[-1]:
        points.append(points[0])
    return struct.pack("<I", len(points)) + b"".join(struct.pack("<dd", *point) for point in points)


def polygons_to_wkb(polygons):
    """A little-endian WKB MultiPolygon of [[shell, hole, ...], ...]."""
    parts = [struct.pack("<BII", 1, 6, len(polygons))]
    for rings in polygons:
        parts.append(struct.pack("<BII", 1, 3, len(rings)))
        parts.extend(_ring_to_wkb(ring) for ring in rings)
    return b"".join(parts)


class _Worker:
    def __init__(self, version, run, load, extract):
        self.version, self.run_method, self.load_points, self.extract = version, run, load, extract
        self.loaded = None

    def hello(self, request):
        return {"protocol": PROTOCOL, "version": str(self.version)}

    def load(self, request):
        points = _read_points(request)
        self.loaded, nanoseconds = _timed(self.load_points, points)
        return {"phases_ns": {"load": nanoseconds}}

    def run(self, request):
        # JSON has no infinity: a parameter without a limit is null.
        parameters = {k: float("inf") if v is None else v for k, v in request["parameters"].items()}
        _collect_garbage()
        result, run_ns = _timed(self.run_method, self.loaded, **parameters)
        polygons, extract_ns = _timed(self.extract, result)
        with open(request["result"], "wb") as file:
            file.write(polygons_to_wkb(polygons))
        return {"nonce": request["nonce"], "phases_ns": {"run": run_ns, "extract": extract_ns}}


def serve(version, run, load=lambda points: points, extract=lambda result: result):
    """Answers the harness until it says that it is done. `version`: of the library that runs."""
    worker = _Worker(version, run, load, extract)
    # Cycles are looked for between the runs only, off the clock, as Python's timeit does it. The modules' objects are not
    # looked at again, which would take 10 ms each time.
    gc.disable()
    gc.freeze()
    answers = {"hello": worker.hello, "load": worker.load, "run": worker.run}
    for line in sys.stdin:
        request = json.loads(line)
        if request["request"] == "quit":
            return
        try:
            _reply(answers[request["request"]](request))
        except Unsupported as error:
            _fail("unsupported", error)
        except MemoryError:
            _fail("memory", "the method ran out of memory")
        except ValueError as error:
            _fail("invalid_argument", error)
        except Exception as error:  # whatever a method throws is its result, and the next request is answered
            _fail("error", f"{type(error).__name__}: {error}")
