# encoding: utf-8
"""Cylinders, walls and the engines that move them: YADE.

Shared by stack.py and probe.py, so that the probe measures what the stack runs with.  law.py
says what a contact does.
Units: radius = mass = normal contact stiffness = 1, hence time in sqrt(m/k_n).

The floor y = 0 is one of FLOORS, and the kind matters: on a box or a facet the contact point
lies halfway into the overlap, as between cylinders, on a Wall it lies on the face.
"""
import math

import law
from yade import *
from yade.utils import box, facet, sphere, wall

EVERY_CYLINDER = 1  # bit of the masks below


class Scene:
	"""Cylinders in the x-y plane, each on a floor of its own, and a top wall."""

	def __init__(self, floor_kind, parameters):
		self.floor = FLOORS[floor_kind]
		self.p = p = parameters
		O.reset()
		O.dt = p['time_step']

		self.surface, self.rough, self.smooth = (O.materials.append(law.material(p)) for _ in range(3))
		# On its own YADE takes the smaller friction angle of a pair; name every pair instead.
		friction_angle = MatchMaker(
		        matches=(
		                (self.surface, self.surface, math.atan(p['cylinder_friction'])),
		                (self.surface, self.rough, math.atan(p['floor_friction'])),
		                (self.surface, self.smooth, 0),
		        )
		)

		self.cylinders = []
		self.floors = []
		self.newton = NewtonIntegrator(damping=0)  # the default would damp even gravity
		O.engines = [
		        ForceResetter(),
		        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()]),
		        InteractionLoop(
		                [
		                        Ig2_Sphere_Sphere_ScGeom(),
		                        Ig2_Box_Sphere_ScGeom(),
		                        Ig2_Facet_Sphere_ScGeom(),
		                        Ig2_Wall_Sphere_ScGeom(),
		                ],
		                [law.physics(p, friction_angle, self.surface)],
		                [law.forces()],
		        ),
		        self.newton,
		]

	def add_cylinder(self, x, y):
		"""A unit sphere with the mass and inertia of a unit cylinder, held in the x-y plane.

		Its floor is invisible to the others, so the force on that floor is its floor force.
		"""
		own_floor = EVERY_CYLINDER << 1 + len(self.cylinders)
		body = sphere((x, y, 0), 1, material=self.surface, mask=EVERY_CYLINDER | own_floor)
		body.state.mass = 1
		body.state.inertia = (0.5, 0.5, 0.5)
		body.state.blockedDOFs = 'zXY'
		self.cylinders.append(O.bodies.append(body))
		self.floors.append(O.bodies.append(self.floor(x, material=self.rough, mask=own_floor)))

	def add_top_wall(self, height, speed):
		"""A flat, frictionless wall with its lower face at height, moving down."""
		self.wall = O.bodies.append(wall((0, height, 0), axis=1, material=self.smooth, mask=EVERY_CYLINDER))
		O.bodies[self.wall].state.vel = (0, -speed, 0)

	def wall_force(self):
		"""Force of the top wall, positive in compression."""
		return O.forces.f(self.wall)[1]


# Floors for a cylinder that starts at x and stays within |x| < 40, far from every edge.


def box_floor(x, **kw):
	# The centre decides about rounding errors only: it is where the recorded runs have it.
	return box((math.copysign(50, x), -1, 0), (100, 1, 10), fixed=True, **kw)


def facet_floor(_, **kw):
	return facet([(-100, 0, -50), (0, 0, 100), (100, 0, -50)], **kw)


def wall_floor(_, **kw):
	return wall(0, axis=1, **kw)


FLOORS = {'box': box_floor, 'facet': facet_floor, 'wall': wall_floor}
