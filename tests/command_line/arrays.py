# SPDX-License-Identifier: MIT
"""Writes arrays as NumPy does (NEP 1), with the standard library alone."""
import io
import math
import struct
import zipfile

NAN = math.nan
TYPES = {"<f8": "d", "<f4": "f", ">f8": ">d", "<i8": "q", "|b1": "?"}


def shape_of(values):
    return (len(values), *shape_of(values[0])) if isinstance(values, list) and values else (
        (0,) if isinstance(values, list) else ())


def flat(values):
    return [number for item in values for number in flat(item)] if isinstance(values, list) else [values]


def element(values, index):
    for k in index:
        values = values[k]
    return values


def fortran(values, shape):
    """The numbers with the first axis running fastest."""
    indices = [()]
    for length in reversed(shape):
        indices = [(k, *rest) for rest in indices for k in range(length)]
    return [element(values, index) for index in indices]


def header(descr, shape, fortran_order=False):
    text = f"{{'descr': '{descr}', 'fortran_order': {fortran_order}, 'shape': {shape!r}, }}"
    text += " " * (63 - (10 + len(text)) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode("latin1")


def npy(values, descr="<f8", fortran_order=False):
    shape = shape_of(values)
    numbers = fortran(values, shape) if fortran_order else flat(values)
    code = TYPES[descr]
    order = code[0] if len(code) > 1 else "<"
    return header(descr, shape, fortran_order) + struct.pack(f"{order}{len(numbers)}{code[-1]}", *numbers)


def npy_words(words):
    width = max(map(len, words))
    data = b"".join(word.ljust(width, "\0").encode("utf-32-le") for word in words)
    return header(f"<U{width}", (len(words),)) + data


def npy_pickled():
    """What np.save makes of ragged lists: a header and a pickle."""
    return header("|O", (2,)) + b"\x80\x04]\x94."


def npz(compressed=False, **arrays):
    """Bytes of an archive of arrays (lists, or bytes of an .npy)."""
    file = io.BytesIO()
    method = zipfile.ZIP_DEFLATED if compressed else zipfile.ZIP_STORED
    with zipfile.ZipFile(file, "w", method) as archive:
        for name, values in arrays.items():
            # As NumPy: sizes of 64 bits, whatever the size.
            with archive.open(name + ".npy", "w", force_zip64=True) as member:
                member.write(values if isinstance(values, bytes) else npy(values))
    return file.getvalue()
