# encoding: utf-8
"""Three cylinders stacked between side walls, then compressed by a flat wall: YADE,
ViscElPhys_Basic contacts.

    yade -n -x -j1 side_walls.py box|facet|wall DIR [DIR ...]

with stack.py, contacts.py, law.py and cases.py beside it.  Arguments, units, compression and rows are
those of stack.py, only the preparation is another one, that of arXiv:2511.06807 (supplement,
section I.B).  An example of parameters.json is side_walls_parameters.json.

            1            (1) Cylinders 2 and 3 lie on the floor at rest under gravity.  Frictionless
                             walls, which just touch them, move inwards by A.  Rest.
       |  3   2  |       (2) Cylinder 1, held above them until now, is lowered at constant speed
    ---|---------|---        until it just touches them, and let go.  Rest.
                         (3) The walls move outwards and are taken away.  Rest.

Angles count from the beginning of (1).
"""
import os
import sys

sys.dont_write_bytecode = True  # no __pycache__ in the run directory
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))  # YADE leaves it out
import cases

# stack.py runs its cases as soon as it is imported: give it none.
run_cases, cases.run = cases.run, lambda *_: None
from stack import Stack, advance
from contacts import EVERY_CYLINDER
from yade import O
from yade.utils import wall


class StackBetweenWalls(Stack):
	"""The scene of one case, from the two cylinders on the floor to the end of the compression."""

	def prepare(self):
		p = self.p
		self.set_gravity(p['gravity'])
		top, *bottom = (O.bodies[cylinder] for cylinder in self.cylinders)
		for body in bottom:
			body.state.pos[1] -= p['gravity']
		walls = [self.add_side_wall(x) for x in (2, -2)]

		self.hold(top, p['landing_height'] + p['fall'], 0)
		self.move(walls, -p['push_speed'], p['push_steps'])
		self.move(walls, 0, p['hold_steps'])
		self.hold(top, p['landing_height'] + p['fall'], p['fall_speed'])
		advance(p['fall_steps'])
		self.let_go(top, p['landing_height'], p['landing_speed'])
		advance(p['settle_steps'])
		self.move(walls, p['withdrawal_speed'], p['withdrawal_steps'])
		for side_wall in walls:
			O.bodies.erase(side_wall)
		advance(p['rest_steps'])

	def add_side_wall(self, x):
		return O.bodies.append(wall((x, 0, 0), axis=0, material=self.smooth, mask=EVERY_CYLINDER))

	def move(self, walls, speed, steps):
		"""Moves the walls outwards."""
		for side_wall in walls:
			state = O.bodies[side_wall].state
			state.vel = (speed if state.pos[0] > 0 else -speed, 0, 0)
		advance(steps)

	def hold(self, body, height, speed):
		"""From now on body moves down from height at constant speed, whatever pulls at it."""
		body.state.blockedDOFs = 'xyzXYZ'
		self.put(body, height, speed)

	def let_go(self, body, height, speed):
		body.state.blockedDOFs = 'zXY'
		self.put(body, height, speed)

	def put(self, body, height, speed):
		body.state.pos = (0, height, 0)
		body.state.vel = (0, -speed, 0)


def compress_stack(floor, parameters, out):
	stack = StackBetweenWalls(floor, parameters)
	stack.prepare()
	stack.compress(out)


run_cases('series.csv', compress_stack)
