"""How a verification looks in the tree and in the 3D view. The class name is written into documents: never rename it."""

from __future__ import annotations

from typing import Any

from ..core.removal import bands
from ..document import compat
from ..document.deviation import deviation_of
from . import icons
from .deviation_nodes import DeviationNodes

DISPLAY_MODE = "Deviation"


class VerificationViewProvider(compat.Stateless):
    """One display mode, the colours; the icon tells a result whose path has changed since."""

    def __init__(self, vobj: Any) -> None:
        vobj.Proxy = self

    def attach(self, vobj: Any) -> None:
        self.Object = vobj.Object
        self.nodes = DeviationNodes()
        vobj.addDisplayMode(self.nodes.root, DISPLAY_MODE)
        self._draw(vobj.Object)

    def updateData(self, obj: Any, prop: str) -> None:
        if prop == "Data":
            self._draw(obj)
        if prop == "Outdated":
            obj.ViewObject.signalChangeIcon()

    def _draw(self, obj: Any) -> None:
        if getattr(obj, "Data", ""):
            self.nodes.show(deviation_of(obj), bands.bands(obj.Tolerance.Value))

    def getDisplayModes(self, vobj: Any) -> list[str]:
        return [DISPLAY_MODE]

    def getDefaultDisplayMode(self) -> str:
        return DISPLAY_MODE

    def setDisplayMode(self, mode: str) -> str:
        return mode

    def getIcon(self) -> str:
        return icons.path("problem" if self.Object.Outdated else "verify")

    def claimChildren(self) -> list[Any]:
        return [self.Object.Stock] if self.Object.Stock else []

    def doubleClicked(self, vobj: Any) -> bool:
        from .verification_panel import open_panel

        open_panel(vobj.Object)
        return True


def show(result: Any) -> None:
    """Give a new result its view provider; its stock would hide the colours."""
    VerificationViewProvider(result.ViewObject)
    result.Stock.ViewObject.Visibility = False
