# encoding: utf-8
"""A ring of spheres and one on top of it, compressed by a flat wall: YADE, ViscElPhys_Basic
contacts.

    yade -n -x -j1 spheres.py box|facet|wall DIR [DIR ...]

with spheres_scene.py, contacts.py, law.py and cases.py beside it.  The first argument says what the
floor is made of.  Each DIR holds a parameters.json (an example is spheres_parameters.json) and receives
a series.csv, which appears only when it is complete.

Units: radius = mass = normal contact stiffness = 1, hence time in sqrt(m/k_n).

         4           "spheres" spheres (3 to 6), of which the one numbered "top" rests on all
      3  2  1        others, and those lie in a ring on the floor y = 0.  The parameters say where
    -----------      each starts.  Nothing keeps them on the axis or in a plane.

Preparation, compression and rows are those of stack.py: (a) gravity rises smoothly from 0 to its
value, (b) the stack rests, (c) a frictionless wall that just touches the top sphere moves down at
constant speed.  Only (c) is recorded.

Rows: step 0 is the end of (b).  Positions, angles and contact forces of a row belong to the
same step; only the damping part of a force uses the velocity half a step earlier, as
everywhere in YADE's leapfrog scheme.  Angles are the time integrals of the spin about x, y and z
from the state before (a).
"""
import os
import sys

sys.dont_write_bytecode = True  # no __pycache__ in the run directory
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))  # YADE leaves it out
import cases
from spheres_scene import Spheres
from yade import O, Vector3

OF_SPHERE = 'x y z thetax thetay thetaz floorx floory floorz'.split()


class Stack(Spheres):
	"""The scene of one case, from the spheres as they are given to the end of the compression."""

	def __init__(self, floor, parameters):
		super().__init__(floor, parameters)
		self.numbers = range(1, parameters['spheres'] + 1)
		for number in self.numbers:
			self.add_sphere(*(parameters['initial_%s%d' % (axis, number)] for axis in 'xyz'))
		self.turned = [(state, Vector3(0, 0, 0)) for state in self.states()]  # with the sum of its spins

	def prepare(self):
		"""Raises gravity, with first and second derivatives zero at both ends, and rests."""
		ramp = self.p['ramp_steps']
		for step in range(ramp):
			x = step / ramp
			self.set_gravity(self.p['gravity'] * x**3 * (10 - 15 * x + 6 * x**2))
			self.advance(1)
		self.set_gravity(self.p['gravity'])
		self.advance(self.p['rest_steps'])

	def set_gravity(self, g):
		self.newton.gravity = (0, -g, 0)

	def advance(self, steps):
		"""O.step, not O.run: a run in the background is waited for in slices of 40 ms."""
		for _ in range(steps):
			O.step()
			for state, spins in self.turned:
				spins += state.angVel  # of the middle of the step, by which YADE has turned the sphere

	def compress(self, out):
		"""Lowers the wall from the top of the top sphere and writes the series."""
		p = self.p
		top = O.bodies[self.spheres[p['top'] - 1]].state
		self.add_top_wall(top.pos[1] + 1, p['wall_speed'])

		columns = ['step', 'time', 'wall_force', *('%s%d' % (name, number) for number in self.numbers for name in OF_SPHERE)]
		out.write(','.join(columns) + '\n')
		done = 0
		for step in row_steps(p):
			self.advance(step - done)
			# A step computes the forces at the present positions and then moves on.
			motions = [(*state.pos, *(spins * O.dt)) for state, spins in self.turned]
			self.advance(1)
			done = step + 1
			row = [step * p['time_step'], self.wall_force()]
			for motion, floor in zip(motions, self.floors):
				row += [*motion, *(0 - component for component in O.forces.f(floor))]
			# Numbers of the high-precision builds of YADE are no floats.
			out.write('%d,' % step + ','.join(repr(float(value)) for value in row) + '\n')


def row_steps(p):
	coarse = range(0, p['fine_from_step'], p['coarse_every'])
	fine = range(p['fine_from_step'], p['compression_steps'] + 1, p['fine_every'])
	return [*coarse, *fine]


def compress_stack(floor, parameters, out):
	stack = Stack(floor, parameters)
	stack.prepare()
	stack.compress(out)


cases.run('series.csv', compress_stack)
