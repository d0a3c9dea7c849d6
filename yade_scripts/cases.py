# encoding: utf-8
"""Runs a script of this folder for many cases in one process, because starting YADE takes
longer than most cases.

    yade -n -x -j1 SCRIPT FLOOR DIR [DIR ...]

FLOOR is one of contacts.FLOORS.  Each DIR holds a parameters.json and receives a result,
which appears only when it is complete.  A case that fails prints its traceback, the others
still run, and the exit status is 1.
"""
import gc
import json
import os
import socketserver
import sys
import threading
import time
import traceback

from contacts import FLOORS
from yade import O


def run(result, simulate):
	"""Calls simulate(floor, parameters, out) for every case, where out becomes the file result."""
	close_servers()
	script, *arguments = sys.argv
	problem = complaint(arguments)
	if problem:
		print('%s: %s\nusage: yade -n -x -j1 %s %s DIR [DIR ...]' % (script, problem, script, '|'.join(FLOORS)), file=sys.stderr)
		leave(1)
	floor, *directories = arguments
	failures = 0
	for directory in directories:
		try:
			run_case(floor, directory, result, simulate)
		except Exception:
			failures += 1
			print('%s: case %s failed' % (script, directory), file=sys.stderr)
			traceback.print_exc()
		sys.stdout.flush()
	leave(1 if failures else 0)


def complaint(arguments):
	if not arguments:
		return 'no floor given'
	if arguments[0] not in FLOORS:
		return 'unknown floor %r, known are %s' % (arguments[0], ', '.join(FLOORS))
	if len(arguments) < 2:
		return 'no directory given'
	return None


def run_case(floor, directory, result, simulate):
	started = time.time()
	with open(os.path.join(directory, 'parameters.json')) as file:
		parameters = json.load(file)
	path = os.path.join(directory, result)
	with open(path + '.part', 'w') as out:
		simulate(floor, parameters, out)
	os.replace(path + '.part', path)
	print('%s: %d steps in %.2f s' % (directory, O.iter, time.time() - started))


def close_servers():
	"""YADE opens two TCP ports at its start, one of them a Python prompt; close them."""
	for server in [o for o in gc.get_objects() if isinstance(o, socketserver.BaseServer)]:
		threading.Thread(target=lambda s=server: (s.shutdown(), s.server_close()), daemon=True).start()


def leave(status):
	"""Unlike sys.exit, removes the temporary directory of YADE."""
	sys.stdout.flush()
	sys.stderr.flush()
	O.exitNoBacktrace(status)
