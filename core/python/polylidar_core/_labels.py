"""Labels as integers, from whatever they are."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt


def numbered(labels: npt.ArrayLike, count: int) -> tuple[npt.NDArray[np.int64], list[Any] | None]:
    """`count` labels as integers in the same order, and the label that each integer stands for; None where the labels
    are such integers themselves. Raises ValueError."""
    if isinstance(labels, np.ma.MaskedArray) and np.any(labels.mask):
        raise ValueError("labels are masked: leave out the points without a label")
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
    except TypeError as error:
        raise ValueError("labels must be hashable, such as numbers, text or dates") from error
    for label in distinct:
        if _is_missing(label):
            place = next(i for i, each in enumerate(values) if each is label)
            raise ValueError(f"label {place} is missing ({label}): leave out the points without a label")
    try:
        names = sorted(distinct)
    except TypeError as error:
        types = " and ".join(sorted({type(label).__name__ for label in values}))
        raise ValueError(f"labels must have an order: those of the types {types} cannot be sorted") from error
    numbers = {label: number for number, label in enumerate(names)}
    return np.fromiter(map(numbers.__getitem__, values), np.int64, len(values)), names


def _is_missing(label: Any) -> bool:
    """None, NaN, NaT or pandas.NA, of which bool() raises an error."""
    try:
        return label is None or bool(label != label)
    except TypeError:
        return True
