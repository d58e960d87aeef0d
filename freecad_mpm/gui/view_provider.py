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
        """Called for new and for restored operations, before CAM's own nodes are there."""
        super().attach(vobj)
        self.nodes = ToolpathNodes()
        self._mounted = False

    def updateData(self, obj: Any, prop: str) -> None:
        super().updateData(obj, prop)
        if prop in DRAWN:
            self._mount()
            self._draw(obj)
        if prop == "Problem":
            self.vobj.signalChangeIcon()

    def _mount(self) -> None:
        """Hang our nodes beside the path that CAM draws: CAM owns the display modes, and this follows Visibility."""
        switch = self.vobj.SwitchNode
        if not self._mounted and switch.getNumChildren():
            switch.getChild(0).addChild(self.nodes.root)
            self._mounted = True

    def _draw(self, obj: Any) -> None:
        moves = cl_path.from_commands(obj.Path.Commands)
        names = [*obj.StatusNames, ""]  # NO_STATUS is -1
        codes = obj.MoveStatus
        statuses = [names[code] for code in codes] if len(codes) == len(moves) else [""] * len(moves)
        self.nodes.show(moves, statuses, obj.FirstContacts, obj.SecondContacts)

    def getIcon(self) -> str:
        if not self.Object.Active:
            return icons.path("inactive")
        return icons.path("problem" if self.Object.Problem else "multi_point_finish")

    def getSelectionFactory(self) -> Any:
        from .selection import select_faces

        return select_faces


def show(op: Any) -> None:
    """Give a new operation its view provider."""
    MultiPointFinishViewProvider(op.ViewObject)
