import hullbench_worker


def turns_left(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])


def half_hull(points):
    chain = []
    for point in points:
        while len(chain) > 1 and not turns_left(chain[-2], chain[-1], point):
            chain.pop()
        chain.append(point)
    return chain[:-1]


def run(points):
    """The convex hull (A. M. Andrew's monotone chain): put the method here."""
    ordered = sorted(set(map(tuple, points)))
    ring = half_hull(ordered) + half_hull(ordered[::-1])
    return [[ring]] if len(ring) > 2 else []


hullbench_worker.serve(version="0.1", run=run)
