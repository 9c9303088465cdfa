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


def _column(name, values, kind):
    """A whole number, or an array or list of them, of this type of C."""
    if numpy is None:
        return [whole(name, one, kind) for one in values] if hasattr(values, "__iter__") else whole(name, values, kind)
    array = numpy.asarray(values)
    if array.size and array.dtype.kind not in "iub":
        raise TypeError(f"{name} is refused: integers are wanted, not {array.dtype}: round to counts first")
    low, high = WHOLE[kind]
    for one in array[(array < low) | (array > high)][:1]:
        whole(name, one, kind)
    return array.astype(kind[:-len("_t")])


def each(function, own, arguments):
    """What a function of C gives for each element of its arguments: an array, as numpy broadcasts
    them, or a list without numpy. It is called once, by the loop that build_library.py made of it."""
    loop = getattr(lib, f"each_{function}")
    *kinds, result = [kind.item.cname for kind in ffi.typeof(loop).args[2:]]
    names = [name for name, _ in _headers.FUNCTIONS[function][1]]
    if len(arguments) != len(names):
        raise TypeError(f"{', '.join(names)} are wanted, not {len(arguments)} arguments")
    columns = list(map(_column, names, arguments, kinds))
    if numpy is not None:
        columns = numpy.broadcast_arrays(*columns)
        found = numpy.empty(columns[0].shape, "bool" if result == "_Bool" else result[:-len("_t")])
        loop(own, found.size, *(ffi.from_buffer(f"{kind}[]", numpy.ascontiguousarray(one)) for kind, one in zip(kinds, columns)),
             ffi.from_buffer(f"{result}[]", found))
        return found
    sizes = {len(one) for one in columns if isinstance(one, list)}
    if len(sizes) != 1:
        raise ValueError(f"sequences of one length are wanted, not of {sorted(sizes)}")
    size = min(sizes)
    found = ffi.new(f"{result}[]", size)
    loop(own, size, *(ffi.new(f"{kind}[]", one if isinstance(one, list) else [one] * size)
                      for kind, one in zip(kinds, columns)), found)
    return ffi.unpack(found, size)
