"""What the types do not allow: each line that says so must be an error, and no other."""
from polylidar_core import concave_hull, concave_hulls, delaunay

hull = concave_hull([(0, 0)])
concave_hull()  # wrong: points are missing
concave_hull([(0, 0)], 1.0)  # wrong: a limit has a name
concave_hull([(0, 0)], aplha=1.0)  # wrong: no such option
concave_hull([(0, 0)], alpha="1")  # wrong: no number
concave_hull([(0, 0)], threads=1.5)  # wrong: no whole number
concave_hulls([(0, 0)])  # wrong: labels are missing
hull.sizes[0]  # wrong: it may be None
hull.polygon  # wrong: no such member
delaunay([(0, 0)]).vertices  # wrong: an array has none
