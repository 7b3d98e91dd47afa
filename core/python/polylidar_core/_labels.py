"""Labels as integers, from whatever they are."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt


def numbered(labels: npt.ArrayLike, count: int) -> tuple[npt.NDArray[np.int64], list[Any] | None]:
    """`count` labels as integers in the same order, and the label that each integer stands for; None where the labels
    are such integers themselves. Raises ValueError."""
    array = np.asarray(labels)
    if array.ndim != 1:
        raise ValueError(f"labels must have the shape (n,), not {array.shape}: give one label a point")
    if len(array) != count:
        raise ValueError(f"there must be one label a point: there are {len(array)} labels and {count} points")
    if array.dtype.kind in "iu" and np.can_cast(array.dtype, np.int64):
        return np.require(array, np.int64, ["C", "ALIGNED"]), None
    # Dates stay numpy's: Python has none for every unit. Of a list in which only some labels are text, numpy makes text.
    values = list(array) if array.dtype.kind in "mM" else np.asarray(labels, object).tolist()
    try:
        distinct = dict.fromkeys(values)
        for label in distinct:
            if label is None or label != label:
                raise ValueError(f"label {values.index(label)} is missing ({label}): leave out the points without a label")
        names = sorted(distinct)
    except TypeError as error:
        types = " and ".join(sorted({type(label).__name__ for label in values}))
        raise ValueError(f"labels must have an order: those of the types {types} cannot be sorted") from error
    numbers = {label: number for number, label in enumerate(names)}
    return np.fromiter(map(numbers.__getitem__, values), np.int64, len(values)), names
