# SPDX-License-Identifier: MIT
"""What all modules need of C: structures, numbers that fit them, and arrays."""
import operator

from . import _headers
from ._library import ffi, lib

try:
    import numpy
except ImportError:
    numpy = None  # type: ignore[assignment]  # lists then take the place of arrays

__version__ = f"{lib.FIXPID_VERSION_MAJOR}.{lib.FIXPID_VERSION_MINOR}.{lib.FIXPID_VERSION_PATCH}"

WHOLE = {f"{sign}int{bits}_t": (-2**(bits - 1), 2**(bits - 1) - 1) if not sign else (0, 2**bits - 1)
         for sign in ("", "u") for bits in (8, 16, 32)}


def fields_of(struct):
    """A structure as a dictionary."""
    fields = ((name, getattr(struct, name)) for name, _ in ffi.typeof(struct).fields)
    return {name: fields_of(value) if isinstance(value, ffi.CData) else value
            for name, value in fields}


def whole(name, value, kind):
    """A whole number for C; who passes another one is told which."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} = {value!r} is refused: a whole number is wanted") from None
    low, high = WHOLE.get(kind, (number, number))
    if not low <= number <= high:
        raise OverflowError(f"{name} = {number} is refused: it does not fit {low}..{high}")
    return number


def _field(owner, name, value, kind):
    """What a field of a structure gets."""
    if kind.kind == "struct":
        if not isinstance(value, dict):
            raise TypeError(f"{name} = {value!r} is refused: a dictionary is wanted, as fixpid.{owner}_{name} makes it")
        return {inner: _field(owner, inner, one, kind_of(kind, inner)) for inner, one in value.items()}
    if kind.kind != "primitive":
        return value  # bytes
    return bool(value) if kind.cname == "_Bool" else whole(name, value, kind.cname)


def kind_of(struct, name):
    """The type of a field; a TypeError with what there is for a name that is none."""
    known = dict(struct.fields)
    if name not in known:
        raise TypeError(f"there is no {name!r}; there are {', '.join(known)}")
    return known[name].type


def new(struct, fields):
    """A structure of C of a dictionary, whose fields are all checked."""
    kind = ffi.typeof(f"struct fixpid_{struct}")
    owner = struct.split("_")[0]
    return ffi.new(f"struct fixpid_{struct} *",
                   {name: _field(owner, name, value, kind_of(kind, name)) for name, value in fields.items()})


def accept(accepted, what):
    """ValueError for what C has refused."""
    if not accepted:
        raise ValueError(f"{what} is refused")


def problem(noun, *numbers):
    """The field that fixpid_..._check names; None where it finds none or does not exist."""
    check = getattr(lib, f"fixpid_{noun}_check", None)
    found = check(*numbers) if check else 0
    name = ffi.typeof(f"enum fixpid_{noun}_problem").elements[found] if found else ""
    return name[len(f"FIXPID_{noun}_BAD_"):].lower() or None


def refusal(noun, struct, config, field):
    """What is said of a field that is refused: its value, and what the header says of it."""
    values, said = {}, {}
    for owner, some in ((struct, config), *((f"{noun}_{name}", one) for name, one in config.items())):
        if isinstance(some, dict):
            values.update(some)
            said.update(_headers.FIELDS[f"fixpid_{owner}"])
    why = _headers.FIELDS[f"fixpid_{noun}_problem"][f"FIXPID_{noun}_BAD_{field}".upper()]
    return f"{field} = {values[field]} is refused: {why or said[field]}"


def counts(numbers):
    """What of a whole array goes into the library: whole numbers only."""
    array = numpy.asarray(numbers)
    if array.dtype.kind not in "iub":
        raise TypeError(f"integers are wanted, not {array.dtype}: round to counts first")
    return array


def each(function, arguments, kind):
    """A function for each element of arrays, which are broadcast; of lists, without numpy."""
    if numpy is not None:
        arrays = numpy.broadcast_arrays(*arguments)
        flat = numpy.fromiter(map(function, *(array.ravel().tolist() for array in arrays)), kind, arrays[0].size)
        return flat.reshape(arrays[0].shape)
    lists = [list(one) if hasattr(one, "__iter__") else one for one in arguments]
    sizes = {len(one) for one in lists if isinstance(one, list)}
    if len(sizes) != 1:
        raise ValueError(f"sequences of one length are wanted, not of {sorted(sizes)}")
    return list(map(function, *(one if isinstance(one, list) else [one] * min(sizes) for one in lists)))
