"""Read by FreeCAD when its window starts: the workbench. (There is no __file__ here.)"""

import FreeCADGui


class MultiPointMachiningWorkbench(FreeCADGui.Workbench):
    """One command to finish faces with a toroidal cutter, one to write the program."""

    def __init__(self):
        from freecad_mpm.gui import icons

        self.__class__.MenuText = "Multi-Point Machining"
        self.__class__.ToolTip = (
            "Five-axis finishing with toroidal cutters that touch the part at several points"
        )
        self.__class__.Icon = icons.path("workbench")

    def Initialize(self):
        from freecad_mpm.gui import commands

        names = commands.register()
        self.appendToolbar("Multi-Point Machining", names)
        self.appendMenu("&Multi-Point", names)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


def _install():
    from freecad_mpm import gui

    gui.install()


_install()
FreeCADGui.addWorkbench(MultiPointMachiningWorkbench())
