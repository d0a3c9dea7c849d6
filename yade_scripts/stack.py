# encoding: utf-8
"""Three cylinders in a stack, compressed by a flat wall: YADE, ViscElPhys_Basic contacts.

    yade -n -x -j1 stack.py box|facet|wall DIR [DIR ...]

with contacts.py, law.py and cases.py beside it.  The first argument says what the floor is made of.
Each DIR holds a parameters.json (an example lies beside this script) and receives a
series.csv, which appears only when it is complete.

Units: radius = mass = normal contact stiffness = 1, hence time in sqrt(m/k_n).

         1           Cylinder 1 rests on 2 (right) and 3 (left), which rest on the floor
       3   2         y = 0, all just touching and free of stress.  Every body moves in the
    -----------      x-y plane only: translations x and y, rotation about z.

(a) gravity rises smoothly from 0 to its value, (b) the stack rests, (c) a frictionless wall
that just touches cylinder 1 moves down at constant speed.  Only (c) is recorded.

Rows: step 0 is the end of (b).  Positions, angles and contact forces of a row belong to the
same step; only the damping part of a force uses the velocity half a step earlier, as
everywhere in YADE's leapfrog scheme.  Angles count from the stress-free state before (a),
counter-clockwise positive.
"""
import math
import os
import sys

sys.dont_write_bytecode = True  # no __pycache__ in the run directory
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))  # YADE leaves it out
import cases
from contacts import Scene

COLUMNS = ('step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,'
           'floor_n2,floor_t2,floor_n3,floor_t3')


class Stack(Scene):
	"""The scene of one case, from the stress-free stack to the end of the compression."""

	def __init__(self, floor, parameters):
		super().__init__(floor, parameters)
		for x, y in ((0, 1 + math.sqrt(3)), (1, 1), (-1, 1)):
			self.add_cylinder(x, y)

	def prepare(self):
		"""Raises gravity, with first and second derivatives zero at both ends, and rests."""
		ramp = self.p['ramp_steps']
		for step in range(ramp):
			x = step / ramp
			self.set_gravity(self.p['gravity'] * x**3 * (10 - 15 * x + 6 * x**2))
			O.step()
		self.set_gravity(self.p['gravity'])
		advance(self.p['rest_steps'])

	def set_gravity(self, g):
		self.newton.gravity = (0, -g, 0)

	def compress(self, out):
		"""Lowers the wall from the top of cylinder 1 and writes the series."""
		p = self.p
		top = O.bodies[self.cylinders[0]].state.pos[1] + 1
		self.add_top_wall(top, p['wall_speed'])

		out.write(COLUMNS + '\n')
		done = 0
		for step in row_steps(p):
			advance(step - done)
			# A step computes the forces at the present positions and then moves on.
			positions = self.positions()
			O.step()
			done = step + 1
			row = [step * p['time_step'], self.wall_force(), *positions, *self.floor_forces()]
			# Numbers of the high-precision builds of YADE are no floats.
			out.write('%d,' % step + ','.join(repr(float(value)) for value in row) + '\n')

	def positions(self):
		states = [O.bodies[cylinder].state for cylinder in self.cylinders]
		return [v for s in states for v in (s.pos[0], s.pos[1], 2 * math.atan2(s.ori[2], s.ori[3]))]

	def floor_forces(self):
		"""Normal (+y) and tangential (+x) force of the floor on cylinders 2 and 3."""
		on_floors = [O.forces.f(floor) for floor in self.floors[1:]]
		return [-component for f in on_floors for component in (f[1], f[0])]


def advance(steps):
	"""O.step, not O.run: a run in the background is waited for in slices of 40 ms."""
	for _ in range(steps):
		O.step()


def row_steps(p):
	coarse = range(0, p['fine_from_step'], p['coarse_every'])
	fine = range(p['fine_from_step'], p['compression_steps'] + 1, p['fine_every'])
	return [*coarse, *fine]


def compress_stack(floor, parameters, out):
	stack = Stack(floor, parameters)
	stack.prepare()
	stack.compress(out)


cases.run('series.csv', compress_stack)
