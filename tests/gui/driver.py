"""Runs inside FreeCAD's window: executes every script that appears in the folder MPM_DROP, and writes its answer.

A script sets `result`, which comes back as JSON. Scripts run while a dialog is open too, as its loop keeps the
timer."""

import json
import os
import traceback

import FreeCAD
import FreeCADGui
from PySide import QtCore

FOLDER = os.environ["MPM_DROP"]
POLL_MS = 20
namespace = {"FreeCAD": FreeCAD, "Gui": FreeCADGui}


def run_next():
    for name in sorted(os.listdir(FOLDER)):
        if name.endswith(".py"):
            running = os.path.join(FOLDER, name[:-3] + ".running")
            os.rename(os.path.join(FOLDER, name), running)
            answer(running)


def answer(path):
    namespace["result"] = None
    try:
        with open(path, encoding="utf-8") as script:
            exec(compile(script.read(), path, "exec"), namespace)
        reply = {"value": namespace["result"]}
    except Exception:
        reply = {"error": traceback.format_exc()}
    out = path[: -len(".running")] + ".out"
    with open(out + ".part", "w", encoding="utf-8") as file:
        json.dump(reply, file)
    os.rename(out + ".part", out)


timer = QtCore.QTimer()
timer.timeout.connect(run_next)
timer.start(POLL_MS)
