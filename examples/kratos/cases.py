"""Runs a script of this folder for many cases in one process, because starting Kratos takes as long as
a short case.

    venv/bin/python3 -B SCRIPT BODY DIR [DIR ...]

BODY is one of contacts.BODIES.  Each DIR holds a parameters.json and receives a result, which appears only when it is complete.
"""
import json
import os
import sys


def run(result, simulate):
    """Calls simulate(body, parameters, out) for every case, where out becomes the file result."""
    body, *directories = sys.argv[1:]
    for directory in directories:
        with open(os.path.join(directory, 'parameters.json')) as file:
            parameters = json.load(file)
        path = os.path.join(directory, result)
        with open(path + '.part', 'w') as out:
            simulate(body, parameters, out)
        os.replace(path + '.part', path)
