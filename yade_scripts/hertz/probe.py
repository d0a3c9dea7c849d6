# encoding: utf-8
"""Cylinders 1 and 2 alone, without gravity, for a few steps: what does a Hertz contact do?  YADE.

    yade -n -x -j1 probe.py box|facet|wall DIR [DIR ...]

with contacts.py, law.py and cases.py beside it.  The first argument says what the floor is made of.
Each DIR holds a parameters.json (an example is probe_parameters.json) and receives a
probe.csv, which appears only when it is complete: one row for every step from 0 on.

Units, floor and top wall as in stack.py; the top wall starts to move at step 0.  Positions,
forces and torques (about the centre, counter-clockwise) of a row belong together.  The
velocities of a row, and hence the initial ones, are those half a step earlier, from which
the forces were computed.  Step 0 is a step like any other: tangential springs grow in it.

Takes the place of the probe.py of linear springs.  The motion of cylinder 1 may be prescribed, in
four legs of leg_steps steps each.
"""
import os
import sys

sys.dont_write_bytecode = True  # no __pycache__ in the run directory
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))  # YADE leaves it out
import cases
from contacts import Scene
from yade import O, PyRunner

COLUMNS = 'step,x1,y1,vx1,vy1,spin1,fx1,fy1,torque1,x2,y2,vx2,vy2,spin2,fx2,fy2,torque2,wall_force'


def leg_velocity(p, step):
	"""Velocity of cylinder 1 after a step whose motion is prescribed."""
	leg = 1 + step // p['leg_steps']
	if leg > 4:
		return 0, 0, 0
	return p['leg%d_vx1' % leg], p['leg%d_vy1' % leg], 0


def probe(floor, p, out):
	scene = Scene(floor, p)
	for x, y in ((p['x1'], p['y1']), (p['x2'], p['y2'])):
		scene.add_cylinder(x, y)
	scene.add_top_wall(p['wall_height'], p['wall_speed'])
	one, two = (O.bodies[cylinder].state for cylinder in scene.cylinders)
	one.vel, one.angVel = (p['vx1'], p['vy1'], 0), (0, 0, p['spin1'])
	two.vel, two.angVel = (p['vx2'], p['vy2'], 0), (0, 0, p['spin2'])

	if p['leg_steps']:
		# Between the forces of a step, which belong to the leg before, and its motion.
		def drive():
			one.vel = leg_velocity(p, O.iter)

		one.blockedDOFs = two.blockedDOFs = 'xyzXYZ'
		sys.modules['__main__'].drive = drive  # where the commands of engines are looked up
		driver = PyRunner(command='drive()', iterPeriod=1, initRun=True)
		O.engines = O.engines[:-1] + [driver, scene.newton]

	out.write(COLUMNS + '\n')
	for step in range(p['steps'] + 1):
		# A step computes the forces at the present positions and then moves on.
		motion = [(s.pos[0], s.pos[1], s.vel[0], s.vel[1], s.angVel[2]) for s in (one, two)]
		O.step()
		forces = [O.forces.f(cylinder) for cylinder in scene.cylinders]
		torques = [O.forces.t(cylinder) for cylinder in scene.cylinders]
		row = [step]
		for m, f, t in zip(motion, forces, torques):
			row += [*m, f[0], f[1], t[2]]
		row.append(scene.wall_force())
		out.write(','.join(map(repr, row)) + '\n')


cases.run('probe.csv', probe)
