import numpy as np
import numpy.typing as npt

__version__: str

def concave_hull(
    points: npt.NDArray[np.float64], alpha: float, max_edge_length: float, threads: int
) -> tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32], npt.NDArray[np.uint32], float]: ...
def delaunay(points: npt.NDArray[np.float64]) -> npt.NDArray[np.uint32]: ...
