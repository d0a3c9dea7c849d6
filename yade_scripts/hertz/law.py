# encoding: utf-8
"""Contact law: YADE, Law2_ScGeom_MindlinPhys_Mindlin, Hertz and Mindlin.

Takes the place of the law.py of linear springs.  A floor is as stiff as a pair, on a facet
sqrt(4/3) times: YADE gives a wall the radius of the sphere, a facet twice that radius.
"""
import math
import sys

from yade import *


def material(p):
	"""Cylinders and walls, of one material."""
	return FrictMat(young=p['youngs_modulus'], poisson=p['poisson_ratio'])


def physics(p, friction_angle, cylinders):
	"""What finds the coefficients of a contact."""
	# Parts of critical damping, to which the effective mass belongs: m of a wall, m/2 of a pair.
	wall = p['damping_normal'] / (2 * math.sqrt(1.5 * p['normal_stiffness']))
	ratio = MatchMaker(algo='val', val=wall, matches=((cylinders, cylinders, math.sqrt(2) * wall),))
	# The top wall is a Wall.  Above a floor of facets it is of a stiffer material, so that both walls have
	# one stiffness.
	if sys.argv[1] == 'facet':
		top = O.materials[2]
		top.young = top.young / (2 / math.sqrt(4 / 3) - 1)
	return Ip2_FrictMat_FrictMat_MindlinPhys(betan=ratio, betas=ratio, frictAngle=friction_angle)


def forces():
	"""What finds its forces."""
	return Law2_ScGeom_MindlinPhys_Mindlin()
