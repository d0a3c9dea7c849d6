"""Runs a script of this folder for many cases in one process, because GeoTaichi is compiled anew in each.

    venv/bin/python3 -B SCRIPT ENGINE DIR [DIR ...]

ENGINE is one of GeoTaichi's time integrations.  Each DIR holds a task.json and receives a result, which appears only
when it is complete.
"""
import json
import os
import sys


def run(bodies, simulate):
    """Calls simulate(scene, task, write) for every case; write makes a row of its arguments."""
    from contacts import Scene

    engine, *directories = sys.argv[1:]
    scene = Scene(bodies, engine)
    for directory in directories:
        with open(os.path.join(directory, 'task.json')) as file:
            task = json.load(file)
        path = os.path.join(directory, 'result.csv')
        with open(path + '.part', 'w') as out:
            simulate(scene, task, lambda *row: print(*row, sep=',', file=out))
        os.replace(path + '.part', path)
