"""How the operation looks in the tree and in the 3D view. The class name is written into documents: never rename it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from ..document import cl_path, compat
from . import icons
from .edit_page import EditPage
from .toolpath_nodes import ToolpathNodes

# Properties whose change alters the picture; Path comes last when an operation is computed.
DRAWN = ("Path", "MoveStatus", "FirstContacts", "SecondContacts")


class MultiPointFinishViewProvider(compat.op_gui.ViewProvider):
    """CAM's view provider for operations, with our drawing, icon, edit page and face picking."""

    def __init__(self, vobj: Any) -> None:
        page = SimpleNamespace(name="Multi-Point Finish", pixmap="", opPageClass=EditPage)
        super().__init__(vobj, page)
        self.deleteOnReject = False  # the operation is complete before its page opens
        vobj.Proxy = self

    def attach(self, vobj: Any) -> None:
        """Called for new and for restored operations."""
        super().attach(vobj)
        self._nodes = ToolpathNodes()
        # CAM's own provider decides the display modes: what is to follow Visibility goes under its switch.
        vobj.SwitchNode.getChild(0).addChild(self._nodes.root)
        self._draw(vobj.Object)

    def updateData(self, obj: Any, prop: str) -> None:
        super().updateData(obj, prop)
        if prop in DRAWN and hasattr(self, "_nodes"):
            self._draw(obj)

    def _draw(self, obj: Any) -> None:
        moves = cl_path.from_commands(obj.Path.Commands)
        names = [*obj.StatusNames, ""]  # NO_STATUS is -1
        codes = obj.MoveStatus
        statuses = [names[code] for code in codes] if len(codes) == len(moves) else [""] * len(moves)
        self._nodes.show(moves, statuses, obj.FirstContacts, obj.SecondContacts)

    def getIcon(self) -> str:
        return icons.path("multi_point_finish" if self.Object.Active else "inactive")

    def getSelectionFactory(self) -> Any:
        from .selection import select_faces

        return select_faces


def show(op: Any) -> None:
    """Give a new operation its view provider, and draw it."""
    op.ViewObject.Proxy = MultiPointFinishViewProvider(op.ViewObject)
    op.ViewObject.Proxy.attach(op.ViewObject)
