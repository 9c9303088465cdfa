# SPDX-License-Identifier: MIT
"""What the headers of include/ say, for help(), for messages and for type checkers.

A comment belongs to what follows it without an empty line, or to the line that it ends.
`write(FOLDER, PATHS)` makes `_headers.py`, which the package reads, and `_nouns.pyi`, which
a type checker reads.
"""
import os
import pprint
import re
import textwrap

EXTENDED = ("Autotune", "Pid", "Reaction")  # classes of which Python has more: not for `from ._nouns import *`
WITHOUT = ("link",)  # the board's end, of which Python is the other: no class is made of it
TRAILING = 8  # a comment that begins further to the right goes on with the line above
FUNCTION = re.compile(r"(?:static inline )?((?:const )?[\w ]+?[ *]+)(fixpid_\w+)\(([^{;]*)\)\s*[;{]")
ARGUMENT = re.compile(r"(?:FIXPID_DATA )?(.*?)\s*(\*?)(\w+)(\[\w*\])?$")
MEMBER = re.compile(r" +(?:volatile )?((?:struct )?\w+) (\w+)(\[\w+\])?;")
ENUMERATOR = re.compile(r" +(FIXPID_\w+)(?: = [\w()]+)?,?\s*$")
CONSTANT = re.compile(r"#define (FIXPID_\w+) (\S+)\s*$")
NUMBER = re.compile(r"(?:0x[0-9A-F]+|\d+)[uUlL]*")


def prose(lines):
    """Comment lines as paragraphs. What is indented keeps its lines."""
    text = "\n".join(re.sub(r"^\s*// ?", "", line).rstrip() for line in lines)
    text = re.sub(r"(?<=[^\n])\n(?=[^\s])", " ", text)
    return re.sub(r"\bFIXPID_(?=[A-Z])", "", text).strip()


class Headers:
    """All headers: `nouns` has the prose of each, `functions` [prose, arguments, result],
    `fields` of each structure or enumeration a comment and a type, and `constants`."""

    def __init__(self, paths):
        self.nouns, self.functions, self.fields, self.constants = {}, {}, {}, {}
        self.inside = set()  # structures that are fields of what a method takes
        for path in paths:
            with open(path, encoding="utf-8") as file:
                text = re.sub(r"\\\n\s*", "", file.read())
            noun = re.sub(r"^fixpid_?|\.h$", "", os.path.basename(path))
            self.nouns[noun] = ""
            self._read(noun, text.split("\n"))

    def _read(self, noun, lines):
        above, last, owner = [], None, None
        for at, line in enumerate(lines):
            code, slashes, said = line.partition("//")
            if slashes and not code.strip() and last is not None and len(code) > TRAILING:
                last[0] = f"{last[0]} {prose([said])}".strip()
            elif slashes and not code.strip():
                above, last = above + [line], None
            elif not code.strip():
                above, last = [], None
            elif code.startswith("#ifndef FIXPID_") and not self.nouns[noun]:
                self.nouns[noun] = prose(above)
            elif re.match(r"(?:struct|enum|union) fixpid_\w+ \{", code):
                owner = self.fields.setdefault(code.split()[1], {})
                if "}" in code:  # in one line
                    owner.update((name, ["", "int"]) for name in re.findall(r"\bFIXPID_\w+", code))
                    owner = None
                above, last = [], None
            elif code.startswith("}"):
                above, last, owner = [], None, None
            elif owner is None and self._function(lines[at:at + 8], above):
                last = None
            else:
                last = self._member(owner, code, above, said) or last

    def _function(self, lines, above):
        found = FUNCTION.match(" ".join(line.strip() for line in lines))
        if found is None:
            return False
        kind, name, arguments = (part.strip() for part in found.groups())
        pairs = [ARGUMENT.match(one.strip()).groups() for one in arguments.split(",")]
        self.functions[name] = [prose(above), [(name, kind + ("*" if array else star)) for kind, star, name, array in pairs
                                               if name not in ("self", "void")], kind]
        return True

    def _member(self, owner, code, above, said):
        """Notes a field or a constant, with its comment in front."""
        found = (MEMBER.match(code) or ENUMERATOR.match(code)) if owner is not None else CONSTANT.match(code)
        if found is None or (owner is None and not NUMBER.fullmatch(found.group(2))):
            return None
        name, kind = found.group(1), "int"
        if found.re is MEMBER:
            name, kind = found.group(2), found.group(1) + (found.group(3) or "")
        owner = self.constants if owner is None else owner
        owner[name] = [" ".join(filter(None, (prose(above), prose([said])))), kind]
        return owner[name]

    # ---- for type checkers ----

    def _type(self, kind):
        if kind.startswith("struct "):
            self.inside.add(kind)
            return "".join(map(str.capitalize, kind[len("struct fixpid_"):].split("_")))
        return "bool" if kind == "bool" else "int"

    def arguments(self, pairs):
        """Of a method: numbers one after the other, or the fields of a structure by name.
        None where it is neither: Python has a method of its own."""
        if len(pairs) == 1 and pairs[0][1].startswith("const struct ") and pairs[0][1].endswith("*"):
            fields = self.fields[pairs[0][1][len("const struct "):-1].strip()]
            if any(kind.endswith("]") for _, kind in fields.values()):
                return None
            return "*, " + ", ".join(f"{name}: {self._type(kind)} = ..." for name, (_, kind) in fields.items())
        if any(kind.endswith("*") for _, kind in pairs):
            return None
        return ", ".join(f"{name}: {self._type(kind)}" for name, kind in pairs) + (", /" if pairs else "")

    def _method(self, verb, function):
        said, pairs, result = self.functions[function]
        arguments = self.arguments(pairs)
        if arguments is None:
            return []
        judges = result == "bool" and not verb.startswith("step")
        result = "None" if judges or result == "void" else self._type(result)
        own = f"self, {arguments}".rstrip(", ")
        said = textwrap.indent(said.replace("\\", r"\\"), " " * 8).strip()
        return [f"    def {verb}({own}) -> {result}:", f'        """{said}"""', ""]

    def _noun(self, noun):
        said = textwrap.indent(self.nouns[noun].replace("\\", r"\\"), " " * 4).strip()
        lines = [f"class {noun.capitalize()}(Noun):", f'    """{said}"""', ""]
        lines += self._method("__init__", f"fixpid_{noun}_init")
        for function, (_, pairs, _) in self.functions.items():
            verb = function[len(f"fixpid_{noun}_"):]
            if not function.startswith(f"fixpid_{noun}_") or verb.startswith("8bit_"):
                continue
            if verb == "check":
                lines += ["    @staticmethod", f"    def check({self.arguments(pairs)}) -> Optional[str]: ...", ""]
            else:
                lines += self._method(verb, function)
        return lines

    def classes(self):
        """The text of `_nouns.pyi`."""
        enumerators = [name for fields in self.fields.values() for name in fields if name.startswith("FIXPID_")]
        nouns = [line for noun in self.nouns
                 if f"fixpid_{noun}_init" in self.functions and noun not in WITHOUT for line in self._noun(noun)]
        constants = [name[len("FIXPID_"):] for name in sorted({*self.constants, *enumerators})]
        classes = [line[len("class "):-len("(Noun):")] for line in nouns if line.startswith("class ")]
        exported = ["Noun", *(name for name in classes if name not in EXTENDED), *constants]
        lines = ["# Written by headers.py from include/.", "from typing import Any, Optional, TypedDict", "",
                 *textwrap.wrap(f"__all__ = {exported}", 100), "", *(f"{name}: int" for name in constants)]
        for kind in sorted(self.inside):
            lines += ["", f"class {self._type(kind)}(TypedDict, total=False):"]
            lines += [f"    {name}: {self._type(own)}" for name, (_, own) in self.fields[kind[len("struct "):]].items()]
        return "\n".join([*lines, "", "class Noun:", "    c: Any", "    def steps(self, *arguments: Any) -> Any: ...", "",
                          *nouns])


def write(folder, paths):
    """Both files, into the folder."""
    headers = Headers(paths)
    functions = {name: (said, tuple(pairs)) for name, (said, pairs, _) in headers.functions.items()}
    fields = {owner: {name: said for name, (said, _) in all_fields.items()}
              for owner, all_fields in headers.fields.items()}
    with open(os.path.join(folder, "_headers.py"), "w", encoding="utf-8") as file:
        file.write("# Written by headers.py from include/.\n")
        for name, value in (("EXTENDED", EXTENDED), ("WITHOUT", WITHOUT), ("NOUNS", headers.nouns), ("FUNCTIONS", functions), ("FIELDS", fields)):
            file.write(f"{name} = {pprint.pformat(value, width=100, sort_dicts=False)}\n")
    with open(os.path.join(folder, "_nouns.pyi"), "w", encoding="utf-8") as file:
        file.write(headers.classes())
