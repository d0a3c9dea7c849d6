# encoding: utf-8
"""Contact law: YADE, ViscElPhys_Basic, linear springs and dashpots."""
from yade import *


def material(p):
	"""Cylinders and walls.  A contact puts its two materials in series, so each gets twice the
	contact's value: 1/(1/2k + 1/2k) = k."""
	return ViscElMat(
	        kn=2 * p['normal_stiffness'],
	        ks=2 * p['tangential_stiffness'],
	        cn=2 * p['damping_normal'],
	        cs=2 * p['damping_tangential'],
	)


def physics(p, friction_angle, cylinders):
	"""What finds the coefficients of a contact."""
	return Ip2_ViscElMat_ViscElMat_ViscElPhys(frictAngle=friction_angle)


def forces():
	"""What finds its forces."""
	return Law2_ScGeom_ViscElPhys_Basic()
