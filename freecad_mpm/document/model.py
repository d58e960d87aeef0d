"""From picked faces to the faces of a Job's model, and from those to arrays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ..core.base import InputError

if TYPE_CHECKING:  # needs the native module, without which picking still answers
    from ..core.part import FaceArrays

FACE = "Face"


@dataclass(frozen=True)
class ModelFaces:
    """The faces of a job's model, global frame."""

    faces: list[FaceArrays]
    machined: list[str]  # names

    @property
    def check(self) -> list[str]:
        """Names of the faces to keep clear of: all that are not machined."""
        return [face.name for face in self.faces if face.name not in set(self.machined)]


def picked_faces(selection: Iterable[Any]) -> list[tuple[Any, str]]:
    """(object, face name) pairs of a selection: pairs (object, "Face1") or (object, ("Face1", ...)), or what
    FreeCADGui.Selection.getSelectionEx() gives. Raises InputError when there is none, or something else is picked.
    """
    pairs = [(obj, name) for item in selection for obj, name in _pairs(item)]
    if not pairs:
        raise InputError("no face is picked: pick one or more faces of the part first")
    for obj, name in pairs:
        _check_face(obj, name)
    return list(dict.fromkeys(pairs))


def _pairs(item: Any) -> list[tuple[Any, str]]:
    obj, names = (item.Object, item.SubElementNames) if hasattr(item, "SubElementNames") else item
    names = [names] if isinstance(names, str) else list(names)
    return [(obj, name) for name in names or [""]]


def _check_face(obj: Any, name: str) -> None:
    if not name.startswith(FACE):
        raise InputError(f"'{obj.Label}': pick faces, not {name or 'the whole object'}")
    count = len(getattr(getattr(obj, "Shape", None), "Faces", ()))
    number = name[len(FACE) :]
    if not number.isdigit() or not 1 <= int(number) <= count:
        raise InputError(f"'{obj.Label}': there is no {name}; it has {count} faces")


def public_object(obj: Any) -> Any:
    """What a Job takes as its model for `obj`: the Body of one of its features, else the object itself."""
    body = obj.getParentGeoFeatureGroup()
    return body if body is not None and body.isDerivedFrom("PartDesign::Body") else obj


def model_of(job: Any, obj: Any) -> Any | None:
    """The object in the job's model that stands for `obj` (itself or its clone), or None."""
    public = public_object(obj)
    for model in job.Model.Group:
        if model in (obj, public) or job.Proxy.baseObject(job, model) in (obj, public):
            return model
    return None


def base_of(job: Any, faces: Sequence[tuple[Any, str]]) -> list[tuple[Any, tuple[str, ...]]]:
    """The picked faces as an operation's Base: the same faces of the job's model."""
    base: dict[Any, list[str]] = {}
    for obj, name in faces:
        model = model_of(job, obj)
        if model is None:
            raise InputError(f"'{obj.Label}': must be in the model of job '{job.Label}'")
        base.setdefault(model, []).append(name)
    return [(model, tuple(names)) for model, names in base.items()]


def model_faces(job: Any, base: Sequence[tuple[Any, Sequence[str]]], chord_mm: float) -> ModelFaces:
    """All faces of the job's model, those of `base` to machine and all others to keep clear of."""
    if not base:
        raise InputError("Base Geometry: must name one or more faces to machine")
    picked = {_name(model, face) for model, faces in base for face in faces}
    every = [face for model in job.Model.Group for face in _named_faces(model, chord_mm)]
    return ModelFaces(every, [face.name for face in every if face.name in picked])


def _named_faces(model: Any, chord_mm: float) -> list[FaceArrays]:
    from .faces import global_shape, read_faces

    faces = read_faces(global_shape(model), chord_mm)
    return [replace(face, name=_name(model, face.name)) for face in faces]


def _name(model: Any, face: str) -> str:
    return f"{model.Name}.{face}"
