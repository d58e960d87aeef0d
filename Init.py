"""Read by FreeCAD at start, with and without the GUI: makes the add-on's posts known to CAM."""

import FreeCAD


def _register_posts() -> None:
    from freecad_mpm.document import posts

    try:
        posts.register()
    except ImportError as error:
        FreeCAD.Console.PrintWarning(
            f"Multi-Point Machining: CAM cannot be loaded, its posts are not there: {error}\n"
        )


_register_posts()
