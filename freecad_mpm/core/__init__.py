"""Jobs, plans, programs and reports, without FreeCAD and without Qt."""
