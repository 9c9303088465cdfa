# SPDX-License-Identifier: MIT
"""A class for each noun of C, with a method for each of its functions; and the headers'
constants, without FIXPID_. `_nouns.pyi`, written from the headers, has them all in full."""
import inspect
import operator

from . import _headers
from ._core import __version__, accept, each, fields_of, new, problem, refusal, whole
from ._library import ffi, lib

globals().update({name[len("FIXPID_"):]: getattr(lib, name) for name in dir(lib)
                  if name.startswith("FIXPID_")})


def _verb(noun, verb):
    """A method that calls a C function: of integers, or of the fields of a structure."""
    name = f"fixpid_{noun}_{verb}"
    function = getattr(lib, name)
    kinds = [kind.cname for kind in ffi.typeof(function).args[1:]]
    said, pairs = _headers.FUNCTIONS[name]
    names = [argument for argument, _ in pairs]
    judges = ffi.typeof(function).result.cname == "_Bool" and not name.endswith("_step")
    index = operator.index

    def method(self, *arguments):
        try:
            value = function(self.c, *map(index, arguments))
        except (TypeError, OverflowError):
            if len(arguments) == len(names):
                for one in zip(names, arguments, kinds):
                    whole(*one)
            raise
        return accept(value, f"{name}({', '.join(map(str, arguments))})") if judges else value

    def of_fields(self, **fields):
        accept(function(self.c, new(kinds[0][len("struct fixpid_"):-len(" *")], fields)) is not False,
               f"{name}({', '.join(f'{field}={value}' for field, value in fields.items())})")

    method = of_fields if kinds and kinds[0].endswith("*") else method
    method.__name__ = verb
    method.__qualname__ = f"{noun.capitalize()}.{verb}"
    method.__doc__ = said + ("\n\nValueError where C returns false." if judges else "")
    if method is not of_fields:
        method.__signature__ = inspect.Signature(
            [inspect.Parameter(one, inspect.Parameter.POSITIONAL_ONLY) for one in ("self", *names)])
    return method


def _takes(name, noun):
    """True for a function of C whose first argument is the noun's object."""
    first = ffi.typeof(getattr(lib, name)).args[0]
    return first.kind == "pointer" and first.item.cname == f"struct fixpid_{noun}"


class Noun:
    """An object of C, and a method for each function that has its name."""

    c = None  # the structure, for calls of `fixpid.lib` by hand

    def __init_subclass__(cls, noun=None):
        if noun is None:
            return
        wanted = ffi.typeof(getattr(lib, f"fixpid_{noun}_init")).args[1]
        cls._noun, cls._config = noun, wanted.item.cname[len("struct fixpid_"):] if wanted.kind == "pointer" else None
        own = f"fixpid_{noun}_"
        for name in dir(lib):
            verb = name[len(own):]
            if verb == "check" and name.startswith(own):
                cls.check = staticmethod(lambda **config: problem(noun, new(cls._config, config)))
            elif name.startswith(own) and verb != "init" and _takes(name, noun):
                setattr(cls, verb, _verb(noun, verb))

    def __init__(self, *numbers, **config):
        self.c = new(self._noun, {})
        self.init(*numbers, **config)

    def init(self, *numbers, **config):
        """Starts anew, as init does in C: with the fields of a configuration, or with numbers."""
        name = f"fixpid_{self._noun}_init"
        self._said = (numbers, config)
        if self._config:
            if numbers:
                raise TypeError(f"{type(self).__name__} takes its fields by name: "
                                f"{', '.join(dict(ffi.typeof('struct fixpid_' + self._config).fields))}")
            numbers = (new(self._config, config),)
        else:
            names = [one for one, _ in _headers.FUNCTIONS[name][1]]
            given = {**dict.fromkeys(names, 0), **dict(zip(names, numbers)), **config}
            if set(given) != set(names) or len(numbers) > len(names):
                raise TypeError(f"{type(self).__name__} takes {', '.join(names)}")
            numbers = [whole(one, given[one], kind.cname)
                       for one, kind in zip(names, ffi.typeof(getattr(lib, name)).args[1:])]
        accepted = getattr(lib, name)(self.c, *numbers)
        if accepted is False:
            field = problem(self._noun, *numbers)
            given = fields_of(numbers[0][0])
            raise ValueError(refusal(self._noun, self._config, given, field) if field else
                             f"{', '.join(f'{one} = {value}' for one, value in given.items())}: refused. "
                             f"{_headers.FUNCTIONS[name][0]}")

    def steps(self, *arguments):
        """A step for each element of arrays, which numpy broadcasts: an array of results."""
        return each(f"fixpid_{self._noun}_step", self.c, arguments)

    def __repr__(self):
        numbers, config = self._said
        return f"{type(self).__name__}({', '.join([*map(repr, numbers), *(f'{name}={value!r}' for name, value in config.items())])})"

    # ---- a copy goes on by itself from where the object is ----

    def __getstate__(self):
        return {**self.__dict__, "c": bytes(ffi.buffer(self.c)), "version": __version__}

    def __setstate__(self, state):
        state = dict(state)
        if state.pop("version", None) != __version__:
            raise ValueError(f"this was kept by another version of fixpid than {__version__}")
        self.c = new(self._noun, {})
        ffi.buffer(self.c)[:] = state.pop("c")
        self.__dict__.update(state)


def _make():
    for name in dir(lib):
        noun = name[len("fixpid_"):-len("_init")]
        if name.startswith("fixpid_") and name.endswith("_init") and noun not in _headers.WITHOUT:
            globals()[noun.capitalize()] = type(noun.capitalize(), (Noun,), {
                "__doc__": _headers.NOUNS[noun], "__module__": "fixpid"}, noun=noun)


_make()
__all__ = [name for name, value in globals().items()  # the constants, and the classes that nothing extends
           if name[0] != "_" and name not in _headers.EXTENDED and
           (name.isupper() and isinstance(value, int) or isinstance(value, type) and issubclass(value, Noun))]
