import numpy as np
import numpy.typing as npt

__version__: str

def concave_hull(
    points: npt.NDArray[np.float64],
    alpha: float | None,
    max_edge_length: float | None,
    max_perimeter: float | None,
    detail: float,
    fill_single_triangles: bool | None,
    cover: bool,
    one: bool,
    threads: int,
) -> tuple[
    npt.NDArray[np.uint32], npt.NDArray[np.uint32], npt.NDArray[np.uint32], float, tuple[float, float, float] | None
]: ...
def concave_hulls(
    points: npt.NDArray[np.float64],
    labels: npt.NDArray[np.int64],
    alpha: float | None,
    max_edge_length: float | None,
    max_perimeter: float | None,
    detail: float,
    fill_single_triangles: bool | None,
    cover: bool,
    one: bool,
    threads: int,
) -> list[tuple[int, npt.NDArray[np.uint32], npt.NDArray[np.uint32], npt.NDArray[np.uint32], float]]: ...
def delaunay(points: npt.NDArray[np.float64]) -> npt.NDArray[np.uint32]: ...
