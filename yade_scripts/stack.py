# encoding: utf-8
"""Three cylinders in a stack, compressed by a flat wall: YADE, ViscElPhys_Basic contacts.

    yade -n -x -j1 stack.py DIR [DIR ...]

Each DIR holds a parameters.json (an example lies beside this script) and receives a
series.csv.  The cases run one after another in one process, because starting YADE takes
longer than most cases.  A case that fails prints its traceback, the others still run, and
the exit status is 1.  series.csv appears only when it is complete.

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
import gc
import json
import math
import os
import socketserver
import sys
import threading
import time
import traceback

COLUMNS = ('step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,'
           'floor_n2,floor_t2,floor_n3,floor_t3')


class Stack:
	"""The scene of one case, from the stress-free stack to the end of the compression."""

	def __init__(self, parameters):
		self.p = p = parameters
		O.reset()
		O.dt = p['time_step']

		# A contact puts its two materials in series, so each gets twice the contact's value:
		# 1/(1/2k + 1/2k) = k.
		contact = dict(
		        kn=2 * p['normal_stiffness'],
		        ks=2 * p['tangential_stiffness'],
		        cn=2 * p['damping_normal'],
		        cs=2 * p['damping_tangential'],
		)
		surface, floor, self.smooth = (O.materials.append(ViscElMat(**contact)) for _ in range(3))
		# On its own YADE takes the smaller friction angle of a pair; name every pair instead.
		friction_angle = MatchMaker(
		        matches=(
		                (surface, surface, math.atan(p['cylinder_friction'])),
		                (surface, floor, math.atan(p['floor_friction'])),
		                (surface, self.smooth, 0),
		        )
		)

		centres = (0, 1 + math.sqrt(3)), (1, 1), (-1, 1)
		self.cylinders = [cylinder(x, y, surface) for x, y in centres]
		self.plates = [floor_plate(side, floor) for side in (1, -1)]

		self.newton = NewtonIntegrator(damping=0)  # the default would damp even gravity
		O.engines = [
		        ForceResetter(),
		        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb(), Bo1_Wall_Aabb()]),
		        InteractionLoop(
		                [Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
		                [Ip2_ViscElMat_ViscElMat_ViscElPhys(frictAngle=friction_angle)],
		                [Law2_ScGeom_ViscElPhys_Basic()],
		        ),
		        self.newton,
		]

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
		self.wall = O.bodies.append(wall((0, top, 0), axis=1, material=self.smooth))
		O.bodies[self.wall].state.vel = (0, -p['wall_speed'], 0)

		out.write(COLUMNS + '\n')
		done = 0
		for step in row_steps(p):
			advance(step - done)
			# A step computes the forces at the present positions and then moves on.
			positions = self.positions()
			O.step()
			done = step + 1
			row = [step, step * p['time_step'], self.wall_force(), *positions, *self.floor_forces()]
			out.write(','.join(map(repr, row)) + '\n')

	def positions(self):
		states = [O.bodies[cylinder].state for cylinder in self.cylinders]
		return [v for s in states for v in (s.pos[0], s.pos[1], 2 * math.atan2(s.ori[2], s.ori[3]))]

	def wall_force(self):
		return O.forces.f(self.wall)[1]

	def floor_forces(self):
		"""Normal (+y) and tangential (+x) force of the floor on cylinders 2 and 3."""
		on_plates = [O.forces.f(plate) for plate in self.plates]
		return [-component for f in on_plates for component in (f[1], f[0])]


def cylinder(x, y, material):
	"""A unit sphere with the mass and inertia of a unit cylinder, held in the x-y plane."""
	body = sphere((x, y, 0), 1, material=material)
	body.state.mass = 1
	body.state.inertia = (0.5, 0.5, 0.5)
	body.state.blockedDOFs = 'zXY'
	return O.bodies.append(body)


def floor_plate(side, material):
	"""Half of the floor, top face y = 0: x > 0 (side 1) or x < 0 (side -1).

	Each bottom cylinder has a plate of its own, so that the force on the plate is its floor
	force.  A box, because YADE's Wall puts the contact point on its face, not halfway into the
	overlap as between cylinders (no matter for the frictionless top wall).
	"""
	return O.bodies.append(box((side * 50, -1, 0), (50, 1, 10), fixed=True, material=material))


def advance(steps):
	"""O.step, not O.run: a run in the background is waited for in slices of 40 ms."""
	for _ in range(steps):
		O.step()


def row_steps(p):
	coarse = range(0, p['fine_from_step'], p['coarse_every'])
	fine = range(p['fine_from_step'], p['compression_steps'] + 1, p['fine_every'])
	return [*coarse, *fine]


def run_case(directory):
	started = time.time()
	with open(os.path.join(directory, 'parameters.json')) as file:
		stack = Stack(json.load(file))
	stack.prepare()
	series = os.path.join(directory, 'series.csv')
	with open(series + '.part', 'w') as out:
		stack.compress(out)
	os.replace(series + '.part', series)
	print('%s: %d steps in %.2f s' % (directory, O.iter, time.time() - started))


def close_servers():
	"""YADE opens two TCP ports at its start, one of them a Python prompt; close them."""
	for server in [o for o in gc.get_objects() if isinstance(o, socketserver.BaseServer)]:
		threading.Thread(target=lambda s=server: (s.shutdown(), s.server_close()), daemon=True).start()


close_servers()
failures = 0
for directory in sys.argv[1:]:
	try:
		run_case(directory)
	except Exception:
		failures += 1
		print('stack.py: case %s failed' % directory, file=sys.stderr)
		traceback.print_exc()
	sys.stdout.flush()
if len(sys.argv) < 2:
	print('usage: yade -n -x -j1 stack.py DIR [DIR ...]', file=sys.stderr)
sys.stdout.flush()
O.exitNoBacktrace(1 if failures or len(sys.argv) < 2 else 0)  # unlike sys.exit, removes the temporary directory of YADE
