"""Histories and checkpoints open with h5py as they are; the numbers are those of test_history.cpp and test_checkpoint.cpp."""
import h5py
import numpy as np


def test_history(folder):
    i = np.arange(10)
    with h5py.File(folder / "history.h5") as file:
        assert list(file.attrs["columns"]) == [b"time", b"tip_displacement", b"kinetic_energy"]
        np.testing.assert_array_equal(file["time"], 0.25 * i)
        np.testing.assert_array_equal(file["tip_displacement"], -1.0 * i)
        np.testing.assert_array_equal(file["kinetic_energy"], 100.0 + i)
        assert [file[name].attrs["unit"] for name in file.attrs["columns"]] == [b"s", b"m", b"J"]
        assert file["kinetic_energy"].attrs["symbol"] == b"E_k"
        assert file["kinetic_energy"].attrs["description"] == b"Kinetic energy."


def test_checkpoint(folder):
    with h5py.File(folder / "checkpoint.h5") as file:
        assert file.userblock_size == 512
        np.testing.assert_array_equal(file["arrays/neighbour"], np.array([0, 4294967295], dtype=np.uint32))
        assert file["arrays/offset"].dtype == np.int64
        assert file["arrays/stress"].shape == (12,)
        assert file["scalars/step"][0] == 9007199254740993
        assert file["texts/material"][()].decode() == "steel, E = 210 GPa, \u03bd = 0.3\n"
