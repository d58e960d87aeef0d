"""What is wrong between the stub of a native module and the module itself."""

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

PLAIN = {"int": int, "float": float, "str": str, "bool": bool}
SHAPE = re.compile(r"\(\w+,(?: \w+)*(?:, \w+)*\)")
# What pybind11 calls a container of the stub.
LISTED_AS = {"Sequence": "list", "Mapping": "dict", "list": "list", "tuple": "tuple", "dict": "dict"}
# Python's own names in a module and a class.
PRIVATE = re.compile(r"_(?!_init__$)")


@dataclass(frozen=True)
class Stub:
    """A stub's text and what stands in it, in its order."""

    lines: list[str]
    aliases: dict[str, np.dtype[Any]]
    tables: dict[str, dict[str, ast.AnnAssign]]
    constants: dict[str, ast.AnnAssign]
    classes: dict[str, dict[str, ast.FunctionDef]]
    functions: dict[str, ast.FunctionDef]
    order: list[str]  # of constants, classes and functions

    def shapes(self, node: ast.stmt) -> list[str]:
        """The shapes in the comment behind a definition."""
        _, _, comment = self.lines[(node.end_lineno or 0) - 1].partition("  # ")
        return SHAPE.findall(comment)


def read(text: str) -> Stub:
    stub = Stub(text.splitlines(), {}, {}, {}, {}, {}, [])
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign):
            dtype = re.fullmatch(r"NDArray\[np\.(\w+)\]", ast.unparse(node.value))
            assert dtype, ast.unparse(node)
            stub.aliases[ast.unparse(node.targets[0])] = np.dtype(getattr(np, dtype[1]))
        elif isinstance(node, ast.ClassDef) and node.bases:
            inherited = stub.tables.get(ast.unparse(node.bases[0]), {})
            own = {ast.unparse(one.target): one for one in node.body if isinstance(one, ast.AnnAssign)}
            stub.tables[node.name] = inherited | own
        elif isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AnnAssign)):
            name = ast.unparse(node.target) if isinstance(node, ast.AnnAssign) else node.name
            stub.order.append(name)
            if isinstance(node, ast.ClassDef):
                stub.classes[name] = {one.name: one for one in node.body if isinstance(one, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                stub.functions[name] = node
            else:
                stub.constants[name] = node
    return stub


# ---------------------------------------------------------------------------------------------- names, signatures


@dataclass(frozen=True)
class Parameter:
    name: str
    kind: str  # "*": by name only
    type: str
    default: str | None  # as written; None: there is none


def names_and_signatures(stub: Stub, module: ModuleType) -> Iterator[str]:
    """Names in another order, and methods and functions whose parameters or types differ."""
    yield from _differ(module.__name__, stub.order, _public(vars(module)))
    for name, node in stub.functions.items():
        yield from _signature(name, node, getattr(module, name, None))
    for name, members in stub.classes.items():
        real = vars(getattr(module, name, object))
        yield from _differ(name, list(members), _public(real))
        for member, node in members.items():
            found = real.get(member)
            kind = [ast.unparse(one) for one in node.decorator_list]
            if kind != ([type(found).__name__] if isinstance(found, (property, staticmethod)) else []):
                yield f"{name}.{member}: is a {type(found).__name__}, the stub has {kind or 'a method'}"
            elif not isinstance(found, property):
                yield from _signature(f"{name}.{member}", node, found)


def _public(names: Mapping[str, object]) -> list[str]:
    return [name for name in names if not PRIVATE.match(name)]


def _differ(where: str, written: list[str], real: list[str]) -> Iterator[str]:
    if written != real:
        yield f"{where}: has {real}, the stub {written}"


def _signature(where: str, node: ast.FunctionDef, function: Any) -> Iterator[str]:
    line = (getattr(function, "__func__", function).__doc__ or "").split("\n")[0]
    _, _, rest = line.partition("(")
    listed, _, returned = rest.rpartition(") -> ")
    written, real = _of_stub(node), _of_docstring(listed)
    if [(one.name, one.kind) for one in written] != [(one.name, one.kind) for one in real]:
        yield f"{where}: takes ({listed}), the stub says ({', '.join(one.kind + one.name for one in written)})"
        return
    for one, other in zip(written, real):
        if (one.default is None) != (other.default is None):
            yield f"{where}: default of {one.name}: {other.default}, the stub has {one.default}"
        elif one.default not in (None, "...") and ast.literal_eval(one.default) != _value(other.default):
            yield f"{where}: default of {one.name}: {other.default}, the stub has {one.default}"
        if one.type and not _same_type(one.type, other.type):
            yield f"{where}: {one.name} is {other.type}, the stub has {one.type}"
    if not _same_type(ast.unparse(node.returns), returned):
        yield f"{where}: returns {returned}, the stub has {ast.unparse(node.returns)}"


def _of_stub(node: ast.FunctionDef) -> list[Parameter]:
    a = node.args
    defaults = [None] * (len(a.args) - len(a.defaults)) + a.defaults + a.kw_defaults
    kinds = [""] * len(a.args) + ["*"] * len(a.kwonlyargs)

    def text(one: ast.expr | None) -> str | None:
        return None if one is None else ast.unparse(one)

    return [
        Parameter(one.arg, kind, text(one.annotation) or "", text(default))
        for one, kind, default in zip(a.args + a.kwonlyargs, kinds, defaults)
    ]


def _of_docstring(listed: str) -> list[Parameter]:
    """pybind11 writes `name: type = default`, with a `*` before those that go by name only."""
    result, kind = [], ""
    for one in _split(listed):
        if one == "*":
            kind = "*"
            continue
        name, _, rest = one.partition(": ")
        type_, equals, default = rest.partition(" = ")
        result.append(Parameter(name, kind, type_, default if equals else None))
    return result


def _split(listed: str) -> list[str]:
    """Split at the commas that stand in no bracket."""
    parts, depth = [""], 0
    for c in listed:
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts if part.strip()]


def _value(text: str | None) -> object:
    try:
        return ast.literal_eval(text or "")
    except (SyntaxError, ValueError):
        return text


def _same_type(written: str, real: str) -> bool:
    """Whether a type of the stub is what pybind11 calls so; tables and arrays are looked into by calls only."""
    if real.startswith("Optional["):
        return written.endswith(" | None") and _same_type(written.removesuffix(" | None"), real[9:-1])
    written = written.removesuffix(" | None")
    outer = written.split("[")[0]
    if outer in LISTED_AS:
        return real.split("[")[0].lower() == LISTED_AS[outer]
    if written in (*PLAIN, "None"):
        return written == real
    if written == "ArrayLike" or real.startswith("numpy.ndarray"):
        return real.startswith("numpy.ndarray") and (written == "ArrayLike" or "[" not in written)
    return real in ("dict", written) or real.endswith("." + written)


# ---------------------------------------------------------------------------------------------- values


def values(stub: Stub, module: ModuleType, examples: Mapping[str, object]) -> Iterator[str]:
    """Results of calls, properties of objects (by the name of their class) and constants that are not what the stub
    says; and functions that no example calls."""
    results = {name: node for name, node in stub.functions.items()}
    for owner, members in stub.classes.items():
        for member, node in members.items():
            if [ast.unparse(one) for one in node.decorator_list] == ["property"]:
                yield from _property(stub, f"{owner}.{member}", node, examples.get(owner))
            else:
                results[f"{owner}.{member}"] = node
    for name, node in results.items():
        if ast.unparse(node.returns) == "None":
            continue
        if name not in examples:
            yield f"{name}: returns something, but no example calls it"
        else:
            yield from _value_of(stub, name, node.returns, examples[name], stub.shapes(node))
    for name, constant in stub.constants.items():
        yield from _value_of(stub, name, constant.annotation, getattr(module, name, None), [])


def _property(stub: Stub, name: str, node: ast.FunctionDef, owner: object) -> Iterator[str]:
    value = getattr(owner, node.name, None)
    yield from _value_of(stub, name, node.returns, value, stub.shapes(node))


def _value_of(
    stub: Stub, where: str, node: Any, value: Any, shapes: list[str], sizes: Any = None
) -> Iterator[str]:
    sizes = {} if sizes is None else sizes  # what the letters of the shapes stand for
    text = ast.unparse(node)
    if text in stub.aliases:
        yield from _array(where, stub.aliases[text], value, shapes.pop(0) if shapes else "no shape", sizes)
    elif text in stub.tables:
        yield from _table(stub, where, stub.tables[text], value)
    elif text in PLAIN:
        if type(value) is not PLAIN[text]:
            yield f"{where}: is {value!r}, the stub has {text}"
    elif isinstance(node, ast.BinOp):
        if value is not None:
            yield from _value_of(stub, where, node.left, value, shapes, sizes)
    elif isinstance(node, ast.Subscript):
        yield from _container(stub, where, node, value, shapes, sizes)
    else:
        yield f"{where}: {text} is not understood here"


def _container(
    stub: Stub, where: str, node: ast.Subscript, value: Any, shapes: list[str], sizes: dict[str, int]
) -> Iterator[str]:
    kind = ast.unparse(node.value)
    inside = list(node.slice.elts) if isinstance(node.slice, ast.Tuple) else [node.slice]
    if kind == "Literal":
        if value not in [ast.literal_eval(one) for one in inside]:
            yield f"{where}: is {value!r}, the stub has {ast.unparse(node)}"
        return
    if type(value).__name__ != kind:
        yield f"{where}: is a {type(value).__name__}, the stub has {ast.unparse(node)}"
        return
    if kind == "tuple" and ast.unparse(inside[-1]) != "...":
        if len(value) != len(inside):
            yield f"{where}: has {len(value)} entries, the stub {len(inside)}"
        for one, entry in zip(inside, value):
            yield from _value_of(stub, where, one, entry, shapes, sizes)
        return
    if not value:
        yield f"{where}: is empty in the example, which shows nothing"
    for entry in value.values() if kind == "dict" else value:
        yield from _value_of(stub, where, inside[1] if kind == "dict" else inside[0], entry, list(shapes))


def _table(stub: Stub, where: str, fields: dict[str, ast.AnnAssign], value: Any) -> Iterator[str]:
    if not isinstance(value, dict) or list(value) != list(fields):
        yield f"{where}: has {list(value) if isinstance(value, dict) else value!r}, the stub {list(fields)}"
        return
    sizes: dict[str, int] = {}
    for name, node in fields.items():
        shapes = stub.shapes(node)
        yield from _value_of(stub, f"{where}[{name}]", node.annotation, value[name], shapes, sizes)


def _array(where: str, dtype: np.dtype[Any], value: Any, shape: str, sizes: dict[str, int]) -> Iterator[str]:
    if not isinstance(value, np.ndarray) or value.dtype != dtype:
        yield f"{where}: is {getattr(value, 'dtype', type(value).__name__)}, the stub has {dtype}"
        return
    written = re.findall(r"\w+", shape)
    wanted = [int(one) if one.isdigit() else sizes.setdefault(one, n) for one, n in zip(written, value.shape)]
    if len(written) != value.ndim or tuple(wanted) != value.shape:
        yield f"{where}: has the shape {value.shape}, the stub {shape} with {sizes}"
    if not (value.flags.c_contiguous and value.flags.writeable):
        yield f"{where}: is not a row-major array of its own"
