# encoding: utf-8
"""Solid spheres in three dimensions, between a floor and a top wall: YADE.

Shared by spheres.py and spheres_probe.py, so that the probe measures what the stack runs with.
Units, materials, engines and the kinds of floors are those of contacts.py.
"""
import contacts
from contacts import EVERY_CYLINDER
from yade import O
from yade.utils import box, sphere


class Spheres(contacts.Scene):
	"""Spheres that move freely, each on a floor of its own, and a top wall."""

	def __init__(self, floor_kind, parameters):
		super().__init__(floor_kind, parameters)
		self.floor = FLOORS[floor_kind]
		self.spheres = []

	def add_sphere(self, x, y, z):
		"""A solid unit sphere, free in all six directions.

		Its floor is invisible to the others, so the force on that floor is its floor force.
		"""
		own_floor = EVERY_CYLINDER << 1 + len(self.spheres)
		body = sphere((x, y, z), 1, material=self.surface, mask=EVERY_CYLINDER | own_floor)
		body.state.mass = 1
		body.state.inertia = (0.4, 0.4, 0.4)
		self.spheres.append(O.bodies.append(body))
		self.floors.append(O.bodies.append(self.floor(x, material=self.rough, mask=own_floor)))

	def states(self):
		return [O.bodies[body].state for body in self.spheres]


def box_floor(_, **kw):
	return box((0, -1, 0), (100, 1, 100), fixed=True, **kw)


# The box of contacts.py is narrow in z; facet and wall are not.
FLOORS = {**contacts.FLOORS, 'box': box_floor}
