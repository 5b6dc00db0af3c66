# SPDX-License-Identifier: GPL-3.0-or-later
"""Checkpoints: HDF5 files with a seal, which says that they are whole."""
import hashlib
import io

import numpy as np

from .errors import contents, needed, refuse

_SEAL = 56  # "SPAMckpt" | format | length | SHA-256 of all before
_FORMAT = 1


class CheckpointCase:
    """One case: `label`, `model` in words, `t`, `fields` by name ((N,) or (N, components): position, velocity,
    ..., a symmetric stress as xx, yy, xy), `id`, `body`, `mass` (N,), `reference_position` (N, D)."""

    def __init__(self, group):
        def values(name):
            array = np.asarray(group[name])
            return array[:, 0] if array.ndim == 2 and array.shape[1] == 1 else array

        def vectors(name):
            return np.asarray(group[name])

        self.label = _word(group["label"])
        self.model = _word(group["model"])
        self.t = float(np.asarray(group["t"]).ravel()[0])
        state = group.get("state", {})
        self.fields = {name: vectors("state/" + name) if name in ("position", "velocity")
                       else values("state/" + name) for name in state}
        self.id, self.body, self.mass = (values("particles/" + n) for n in ("id", "body", "mass"))
        self.reference_position = vectors("particles/reference_position")

    def __repr__(self):
        return f"<{self.label or 'case'} at t = {self.t:g}: {', '.join(self.fields)}>"


def _word(dataset):
    value = dataset[()]
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def read_checkpoint(path):
    """The cases of a checkpoint by label. Needs python3-h5py. Raises InputError of one line where the file
    is not a whole checkpoint of a known format."""
    h5py = needed("h5py", "python3-h5py")
    data = contents(path, "checkpoint")
    seal = data[-_SEAL:]
    if len(data) < _SEAL or seal[:8] != b"SPAMckpt":
        refuse(path, "is no checkpoint of spam, or cut short: its end bears no seal; a run keeps two, "
                     "try the other")
    its_format = int.from_bytes(seal[8:16], "little")
    if its_format != _FORMAT:
        refuse(path, f"has format {its_format}, and this version of spam_mechanics reads format "
                     f"{_FORMAT} only; use the version that wrote it")
    if int.from_bytes(seal[16:24], "little") != len(data) - _SEAL or \
            hashlib.sha256(data[:-32]).digest() != seal[-32:]:
        refuse(path, "is damaged: its SHA-256 is not the one of its seal; a run keeps two checkpoints, "
                     "try the other")
    try:
        with h5py.File(io.BytesIO(data[:-_SEAL]), "r") as file:
            cases = [CheckpointCase(file["cases"][k]) for k in sorted(file["cases"], key=int)]
    except (OSError, KeyError, ValueError, RuntimeError, TypeError) as error:
        refuse(path, f"is whole, but not as this version of spam_mechanics knows it ({error})")
    return {case.label: case for case in cases}
