"""The rules of docs/architecture.md, each a function from a checkout to the list of its violations.

A violation is one line: file, what is wrong. The functions read text only; nothing is imported or built.
"""

import ast
import re
import sys
from pathlib import Path

Violations = list[str]

CPP_ENDINGS = {".h", ".inc", ".cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
LITERAL = re.compile(r'"(?:\\.|[^"\\\n])*"' + r"|'(?:\\.|[^'\\\n])'")
SMALL_NUMBER = re.compile(r"(?<![\w.])\d[\d']*\.?\d*[eE]-\d+")
# A member of an options structure with its default: named by the member, so allowed in headers.
MEMBER_DEFAULT = re.compile(r"^\s*double\s+\w+\s*=[^()]*$")
# Taking a stream's buffer away, to keep a library quiet, is not printing.
PRINTS_OR_ENDS = re.compile(
    r"\bstd::(?:cout|cerr|clog|terminate|quick_exit)\b(?!\.rdbuf)"
    r"|(?<!\.)\b(?:printf|fprintf|puts|abort|assert|_?exit)\s*\("
)


def cpp_files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.suffix in CPP_ENDINGS)


def code_only(text: str) -> str:
    """The C++ text without comments and what its literals say."""
    return COMMENT.sub("", LITERAL.sub('""', text))


# ---------------------------------------------------------------------------------------- layer table


def table_rows(text: str, width: int) -> list[list[str]]:
    """The body rows with `width` cells of all Markdown tables in the text."""
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:1] == "|"
    ]
    return [row for row in rows if len(row) == width and not set(row[0]) <= set("- :")]


def native_layers(document: str) -> dict[str, set[str]]:
    """Module -> modules it may include, from the table `layer | native module | charter | may use`."""
    rows = [row for row in table_rows(document, 4) if row[1].startswith("`")]
    layer = {row[1].strip("`"): row[0] for row in rows}
    return {row[1].strip("`"): allowed_modules(row[3], layer) for row in rows}


def allowed_modules(cell: str, layer: dict[str, str]) -> set[str]:
    """`–` nothing; `base, path` those modules; `0–2` all modules of these layers."""
    allowed: set[str] = set()
    for word in (word.strip() for word in cell.split(",") if word.strip() != "–"):
        if span := re.fullmatch(r"(\d)–(\d)", word):
            allowed |= {name for name, at in layer.items() if at.isdigit() and span[1] <= at <= span[2]}
        elif word in layer:
            allowed.add(word)
        else:
            raise ValueError(f'docs/architecture.md: "{word}" is neither a module nor a range of layers')
    return allowed


def layers_of(root: Path) -> dict[str, set[str]]:
    return native_layers((root / "docs/architecture.md").read_text())


def module_includes(root: Path) -> list[tuple[Path, str, str, str]]:
    """All includes of the core: file, its module, name, the module of the name (its own where that is of no module)."""
    found = []
    for path in cpp_files(root / "native/src/mpm"):
        module = path.relative_to(root / "native/src/mpm").parts[0]
        for name in INCLUDE.findall(path.read_text()):
            found.append((path, module, name, name.split("/")[1] if name.startswith("mpm/") else module))
    return found


def native_includes_follow_the_table(root: Path) -> Violations:
    allowed = layers_of(root)
    folders = [path for path in (root / "native/src/mpm").glob("*") if path.is_dir()]
    return [
        f"{folder}: module {folder.name} is not in the layer table"
        for folder in sorted(folders)
        if folder.name not in allowed
    ] + [
        f"{path}: {module} must not include {name}"
        for path, module, name, used in module_includes(root)
        if module in allowed and used != module and used not in allowed[module]
    ]


def native_permissions_are_used(root: Path) -> Violations:
    """The table says what is: a module includes every other one that it may use."""
    uses = {(module, used) for _, module, _, used in module_includes(root)}
    return [
        f"docs/architecture.md: {module} may use {other}, and does not"
        for module, allowed in layers_of(root).items()
        for other in sorted(allowed)
        if (module, other) not in uses
    ]


def judge_is_independent(root: Path) -> Violations:
    """The table itself never lets `gouge` reach `positioning`, directly or through another module."""
    allowed = layers_of(root)
    reached, waiting = set(), ["gouge"]
    while waiting:
        module = waiting.pop()
        reached.add(module)
        waiting += allowed[module] - reached
    return ["docs/architecture.md: gouge may reach positioning"] if "positioning" in reached else []


# ---------------------------------------------------------------------------------------- C++ text


def foreign_includes(root: Path, pattern: str, homes: tuple[str, ...]) -> Violations:
    """Includes that match the pattern outside the homes (files or folders below native/)."""
    native = root / "native"
    return [
        f"{path}: includes {name}, which belongs in {' or '.join(homes)}"
        for path in cpp_files(native)
        for name in INCLUDE.findall(path.read_text())
        if re.search(pattern, name) and not path.relative_to(native).as_posix().startswith(homes)
    ]


def tbb_has_one_door(root: Path) -> Violations:
    return foreign_includes(root, r"^(tbb|oneapi)/", ("src/mpm/base/parallel.cpp",))


def opencascade_stays_in_occt(root: Path) -> Violations:
    return foreign_includes(root, r"\.hxx$", ("src/mpm/occt/", "bindings/occt/", "tests/occt/"))


def core_neither_prints_nor_aborts(root: Path) -> Violations:
    return [
        f"{path}: {match.group()}"
        for path in cpp_files(root / "native/src")
        for match in PRINTS_OR_ENDS.finditer(code_only(path.read_text()))
    ]


def small_numbers_have_names(root: Path) -> Violations:
    """A literal like 1e-9 stands only in a constexpr definition, or as a member's default in a header."""
    found = []
    for path in cpp_files(root / "native/src"):
        for statement in re.split(r"[;{}]", code_only(path.read_text())):
            named = "constexpr" in statement or (path.suffix == ".h" and MEMBER_DEFAULT.match(statement))
            found += [] if named else [f"{path}: bare {number}" for number in SMALL_NUMBER.findall(statement)]
    return found


# ---------------------------------------------------------------------------------------- Python imports

# What the words of the table "package | charter | may import" stand for, besides `x` for freecad_mpm.x.
OUTSIDE_PACKAGES = {
    "numpy": {"numpy"},
    "matplotlib": {"matplotlib", "mpl_toolkits"},
    "FreeCAD": {"FreeCAD", "Part", "Path", "PathScripts", "Import", "Mesh"},
    "FreeCADGui": {"FreeCADGui", "PathGui", "PartGui"},
    "Qt": {"PySide", "PySide2", "PySide6"},
    "Coin": {"pivy"},
}


def python_layers(document: str) -> dict[str, set[str]]:
    """Package below freecad_mpm -> names of the packages it may import, itself among them."""
    rows = [row for row in table_rows(document, 3) if row[0].startswith("`freecad_mpm.")]
    layers = {}
    for row in rows:
        for package in re.findall(r"`freecad_mpm\.(\w+)`", row[0]):
            words = [word.strip(" `") for word in row[2].split(",") if word.strip() != "–"]
            named = [OUTSIDE_PACKAGES.get(word, {f"freecad_mpm.{word}"}) for word in words]
            layers[package] = {f"freecad_mpm.{package}"}.union(*named)
    return layers


def module_name(root: Path, path: Path) -> str:
    return ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")


def imports(root: Path, path: Path) -> set[str]:
    """Absolute names of all modules that the file imports, anywhere in it; `from a import b` gives a.b."""
    package = module_name(root, path).split(".")
    package = package if path.name == "__init__.py" else package[:-1]
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else []
            start = ".".join(above + ([node.module] if node.module else []))
            names |= {f"{start}.{alias.name}" for alias in node.names}
    return names


def within(name: str, packages: set[str]) -> bool:
    return any(name == package or name.startswith(package + ".") for package in packages)


def python_imports_follow_the_table(root: Path) -> Violations:
    found = []
    for layer, packages in python_layers((root / "docs/architecture.md").read_text()).items():
        for path in sorted((root / "freecad_mpm" / layer).rglob("*.py")):
            for name in sorted(imports(root, path)):
                if name.split(".")[0] not in sys.stdlib_module_names and not within(name, packages):
                    found.append(f"{path}: {layer} must not import {name}")
    return found


def no_import_runs_in_a_circle(root: Path) -> Violations:
    """Within `document` and within `gui`; imports inside functions and for types alone count too."""
    found = []
    for layer in ("document", "gui"):
        files = sorted((root / "freecad_mpm" / layer).rglob("*.py"))
        names = {module_name(root, path) for path in files}
        uses = {module_name(root, path): modules_among(names, imports(root, path)) for path in files}
        reached = {name: closure(uses, name) for name in names}
        circles = {tuple(sorted(n for n in reached[m] if m in reached[n])) for m in names if m in reached[m]}
        found += [
            f"freecad_mpm/{layer}: imports in a circle: {', '.join(circle)}" for circle in sorted(circles)
        ]
    return found


def modules_among(names: set[str], imported: set[str]) -> set[str]:
    """The modules meant: `a.b` is the module b of a, or a name in a."""
    return {name if name in names else name.rpartition(".")[0] for name in imported} & names


def closure(uses: dict[str, set[str]], start: str) -> set[str]:
    """All that `start` uses, directly or not; `start` itself when it comes back to it."""
    reached: set[str] = set()
    waiting = list(uses[start])
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached.add(name)
            waiting += uses[name]
    return reached


# ---------------------------------------------------------------------------------------- rooms of core

CORE = "freecad_mpm.core"


def core_rooms(document: str) -> dict[str, set[str]]:
    """Room -> rooms it may use, from the table `room | charter | may use`; `all`: every room above it."""
    rooms: dict[str, set[str]] = {}
    for name, _, cell in (row for row in table_rows(document, 3) if re.fullmatch(r"`[a-z]+`", row[0])):
        words = {word.strip() for word in cell.split(",")} - {"–"}
        allowed = set(rooms) if words == {"all"} else words
        if not allowed <= set(rooms):
            raise ValueError(f"docs/architecture.md: {name} may use {allowed - set(rooms)}, not above it")
        rooms[name.strip("`")] = allowed
    return rooms


def rooms_of(root: Path) -> dict[str, set[str]]:
    return core_rooms((root / "docs/architecture.md").read_text())


def room_imports(root: Path) -> list[tuple[Path, str, list[str]]]:
    """File, name of a room, and what of it the file imports, for all files of the package outside of that room."""
    found = []
    for path in sorted((root / "freecad_mpm").rglob("*.py")):
        own = path.relative_to(root / "freecad_mpm").parts
        for name in sorted(imports(root, path)):
            words = name.split(".")
            if within(name, {CORE}) and len(words) > 2 and own[:2] != ("core", words[2]):
                found.append((path, words[2], words[3:]))
    return found


def rooms_follow_the_table(root: Path) -> Violations:
    allowed = rooms_of(root)
    core = root / "freecad_mpm/core"
    found, used = [], set()
    for path, room, _ in room_imports(root):
        if core in path.parents and path.parent != core:
            own = path.relative_to(core).parts[0]
            used.add((own, room))
            found += [] if room in allowed.get(own, ()) else [f"{path}: {own} must not use {room}"]
    unused = {(own, room) for own in allowed for room in allowed[own]} - used
    return found + [
        f"docs/architecture.md: nothing in {own} uses {room}"
        for own, room in sorted(unused)
        if own != "commands"
    ]


def door_names(root: Path, room: str) -> set[str]:
    """What the room's door offers: its `__all__`."""
    door = root / "freecad_mpm/core" / room / "__init__.py"
    for node in ast.parse(door.read_text()).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return set(ast.literal_eval(node.value))
    return set()


def doors_are_used(root: Path) -> Violations:
    """Nobody reaches behind a room's door."""
    names = {room: door_names(root, room) for room in rooms_of(root)}
    return [
        f"{path}: {room}.{'.'.join(rest)} is not in the room's door"
        for path, room, rest in room_imports(root)
        if rest and (len(rest) > 1 or rest[0] not in names.get(room, ()))
    ]


# The kinematics of the checks, and who may use them beside `control`: what shows a program, never what makes one.
CHECKERS_KINEMATICS = f"{CORE}.control.kinematics"
MAY_USE_KINEMATICS = {f"{CORE}.program.report", f"{CORE}.playback.playback"}


def checks_share_nothing_with_the_writer(root: Path) -> Violations:
    """`control` never reaches `posts`, and nothing that makes a path or a program uses the checker's kinematics."""
    files = {module_name(root, path): path for path in (root / "freecad_mpm").rglob("*.py")}
    reached = sorted(reached_from(root, files, f"{CORE}.control"))
    writers = [module for module in reached if within(module, {f"{CORE}.posts"})]
    found = [f"{files[module]}: control reaches this writer" for module in writers[:1]]
    for module, path in sorted(files.items()):
        free = within(module, {f"{CORE}.control"} | MAY_USE_KINEMATICS)
        if not free and any(within(name, {CHECKERS_KINEMATICS}) for name in imports(root, path)):
            found.append(f"{path}: must not use the kinematics of the checks")
    return found


def reached_from(root: Path, files: dict[str, Path], room: str) -> set[str]:
    """All modules that the modules of a room import, directly or not."""
    reached: set[str] = set()
    waiting = [name for name in files if within(name, {room})]
    while waiting:
        module = waiting.pop()
        if module in reached or module not in files:
            continue
        reached.add(module)
        for name in imports(root, files[module]):
            waiting += [name, name.rpartition(".")[0]]  # `from a import b`: b may be a module or a name in a
    return reached


# ---------------------------------------------------------------------------------------- tests by name


def without_a_test_of_their_name(root: Path) -> list[str]:
    """Modules of core that no tests/core/<room>/test_<module>.py is there for, and native ones (by header) that no
    native/tests/<module>/test_<header>.cpp is there for. Tests of another name may reach them all the same.
    """
    core, native = root / "freecad_mpm/core", root / "native/src/mpm"
    python = [
        path.relative_to(core)
        for path in sorted(core.rglob("*.py"))
        if path.name != "__init__.py" and path.parent != core
    ]
    missing = [
        f"core/{module.with_suffix('').as_posix()}"
        for module in python
        if not (root / "tests/core" / module.with_name(f"test_{module.name}")).exists()
    ]
    headers = [path.relative_to(native) for path in sorted(native.rglob("*.h"))]
    missing += [
        f"native/{header.with_suffix('').as_posix()}"
        for header in headers
        if not (root / "native/tests" / header.with_name(f"test_{header.stem}.cpp")).exists()
    ]
    return missing


# ---------------------------------------------------------------------------------------- the whole tree

NOT_OURS = {".git", "build", "out", "__pycache__", ".pytest_cache", ".mypy_cache", ".hypothesis"}
OUTSIDE = re.compile(r"\.\./shared\b|/work/")


def text_files(root: Path) -> list[Path]:
    return sorted(
        path
        for path in root.rglob("*")
        if path.is_file()
        and not NOT_OURS & set(path.relative_to(root).parts)
        and b"\0" not in path.read_bytes()[:1024]
    )


def stands_alone(root: Path) -> Violations:
    """Nothing needs a folder beside the checkout; only tests may look for more data there."""
    return [
        f"{path}: refers to {match.group()}"
        for path in text_files(root)
        if path.relative_to(root).parts[0] != "tests"
        for match in OUTSIDE.finditer(path.read_text(errors="replace"))
    ]
