#!/usr/bin/env bash
# check_worker_helpers.sh LANGUAGE: what the workers in other languages do between the runs, off the clock.
#
#   javascript   garbage is collected before every run, and the manifests start node so that it can be
#   python       garbage in cycles is collected before a run and not in one
#   java         the same before a run after long ones; a stack that is full is a failed run, after which the worker goes on
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "FAIL: $1" >&2
  exit 1
}

# requests N RUNS PARAMETERS: to load N points of a convex curve and to run so many times.
requests() {
  /usr/bin/env python3 - "$folder" "$@" <<'PYTHON'
import json, struct, sys

folder, n, runs, parameters = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), json.loads(sys.argv[4])
with open(folder + "/points", "wb") as file:
    for i in range(n):
        file.write(struct.pack("<dd", i, i * i))
requests = [{"request": "hello", "protocol": 1}, {"request": "load", "points": folder + "/points", "n": n}]
for i in range(runs):
    requests.append({"request": "run", "nonce": str(i), "parameters": parameters, "result": folder + "/result"})
for request in requests + [{"request": "quit"}]:
    print(json.dumps(request))
PYTHON
}

# expect_events WORDS: what the invented method and collector have written to standard error.
expect_events() {
  local events
  events=$(tr '\n' ' ' <"$folder/events")
  [ "$events" = "$1 " ] || fail "expected '$1', not '$events'"
}

check_javascript() {
  cat >"$folder/worker.mjs" <<JAVASCRIPT
globalThis.gc = (options) => console.error("collect-" + options.type);
const { serve } = await import("$root/adapters/process/hullbench_worker.mjs");
serve({ version: "1", run: () => console.error("run") ?? [], extract: (result) => console.error("extract") ?? result });
JAVASCRIPT
  requests 4 2 '{}' | node "$folder/worker.mjs" >"$folder/replies" 2>"$folder/events"
  expect_events "collect-minor run extract collect-minor run extract"
  sed -i '/globalThis.gc/d' "$folder/worker.mjs"
  requests 4 1 '{}' | node "$folder/worker.mjs" >"$folder/replies" 2>"$folder/events"
  expect_events "run extract"
  local manifest
  for manifest in adapters/manifests/*.json; do
    ! grep -q '"node"' "$manifest" || grep -q '"--expose-gc"' "$manifest" || fail "$manifest starts node without --expose-gc"
  done
  local collections
  collections=$(node --expose-gc --trace-gc -e 'gc({ type: "minor" })')
  [[ $collections == *Scavenge* && $collections != *Mark* ]] || fail "this node does not collect young objects only: $collections"
}

check_python() {
  cat >"$folder/worker.py" <<PYTHON
import sys

sys.path.append("$root/adapters/process")
import hullbench_worker

import gc


def tell(phase, information):
    if phase == "start":
        print("collect", file=sys.stderr)


def run(points):
    print("run", file=sys.stderr)
    for _ in range(20000):  # more cycles than either Python or the helper lets be
        cycle = []
        cycle.append(cycle)
    return []


gc.callbacks.append(tell)
hullbench_worker.serve(version="1", run=run)
PYTHON
  requests 4 2 '{}' | /usr/bin/python3 "$folder/worker.py" >"$folder/replies" 2>"$folder/events"
  local events
  events=$(sed -n '/run/,$p' "$folder/events" | tr '\n' ' ')
  [ "$events" = "run collect run " ] || fail "expected a collection between two runs only, not '$events'"
}

check_java() {
  # In the place of JTS's class: one that recurses for ever over holes, and else leaves 64 MiB.
  mkdir -p "$folder/fake/org/locationtech/jts/algorithm/hull"
  cat >"$folder/ConcaveHull.java" <<'JAVA'
package org.locationtech.jts.algorithm.hull;

import org.locationtech.jts.geom.Geometry;

public class ConcaveHull {
  private static long depth = 0;

  private static long sink(long value) {
    ++depth;
    return sink(value + 1) + 1;
  }

  public static Geometry concaveHullByLengthRatio(Geometry points, double ratio, boolean holes) {
    if (holes) sink(0);
    byte[][] garbage = new byte[64][];
    for (int i = 0; i < garbage.length; ++i) garbage[i] = new byte[1 << 20];
    System.err.println("run " + garbage.length);
    return points.getEnvelope();
  }

  public static Geometry concaveHullByLength(Geometry points, double length, boolean holes) {
    sink(0);
    return points;
  }
}
JAVA
  local jars=/usr/share/java/jts-core.jar:/usr/share/java/gson.jar
  javac -cp "$jars" -d "$folder/fake" "$folder/ConcaveHull.java"
  {
    requests 5 2 '{"length_ratio": 0, "max_edge_length": null, "allow_holes": 0}' | grep -v quit
    requests 5 1 '{"length_ratio": 0, "max_edge_length": null, "allow_holes": 1}' | grep '"run"'
    requests 5 1 '{"length_ratio": 0, "max_edge_length": null, "allow_holes": 0}' | grep '"run"\|quit'
  } | java -Xms1g -Xmx1g -XX:+UseSerialGC -Xlog:gc:file="$folder/gc" -cp "$folder/fake:$jars" \
    adapters/manifests/JtsConcaveHull.java >"$folder/replies" 2>"$folder/events"
  [ "$(wc -l <"$folder/replies")" -eq 6 ] || fail "not every request has an answer: $(cat "$folder/replies" "$folder/events")"
  sed -n 5p "$folder/replies" | grep -q '"kind":"error".*stack' || fail "no failed run: $(sed -n 5p "$folder/replies")"
  sed -n 6p "$folder/replies" | grep -q '"phases_ns"' || fail "no run after the failed one: $(sed -n 6p "$folder/replies")"
  [ "$(grep -c 'System.gc()' "$folder/gc")" -ge 2 ] || fail "no collection before a run after one that left 64 MiB"
}

case ${1:-} in
  javascript | python | java) "check_$1" ;;
  *) fail "name a language: javascript, python or java" ;;
esac
echo "fine"
