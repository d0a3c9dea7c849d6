# encoding: utf-8
"""Spheres 1 and 2 alone, without gravity, for a few steps: what does a contact do in three
dimensions?  YADE.

    yade -n -x -j1 spheres_probe.py box|facet|wall DIR [DIR ...]

with spheres_scene.py, contacts.py, law.py and cases.py beside it.  The first argument says what the
floor is made of.  Each DIR holds a parameters.json (an example is spheres_probe_parameters.json) and
receives a probe.csv, which appears only when it is complete: one row for every step from 0 on.

Units, floor and top wall as in spheres.py; the top wall starts to move at step 0.  Positions,
forces and torques (about the centre) of a row belong together.  The velocities of a row, and hence
the initial ones, are those half a step earlier, from which the forces were computed.  Step 0 is a
step like any other: tangential springs grow in it.
"""
import os
import sys

sys.dont_write_bytecode = True  # no __pycache__ in the run directory
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))  # YADE leaves it out
import cases
from spheres_scene import Spheres
from yade import O

VECTORS = ('', 'v', 'spin', 'f', 'torque')
COLUMNS = ['step', *(vector + axis + number for number in '12' for vector in VECTORS for axis in 'xyz'), 'wall_force']


def probe(floor, p, out):
	def initial(vector, number):
		return [p['%s%s%d' % (vector, axis, number)] for axis in 'xyz']

	scene = Spheres(floor, p)
	for number in (1, 2):
		scene.add_sphere(*initial('', number))
	scene.add_top_wall(p['wall_height'], p['wall_speed'])
	states = scene.states()
	for number, state in enumerate(states, 1):
		state.vel, state.angVel = initial('v', number), initial('spin', number)

	out.write(','.join(COLUMNS) + '\n')
	for step in range(p['steps'] + 1):
		# A step computes the forces at the present positions and then moves on.
		motions = [(*state.pos, *state.vel, *state.angVel) for state in states]
		O.step()
		row = []
		for motion, sphere in zip(motions, scene.spheres):
			row += [*motion, *O.forces.f(sphere), *O.forces.t(sphere)]
		row.append(scene.wall_force())
		# Numbers of the high-precision builds of YADE are no floats.
		out.write('%d,' % step + ','.join(repr(float(value)) for value in row) + '\n')


cases.run('probe.csv', probe)
