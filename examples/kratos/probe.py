"""Cylinders 1 and 2 alone, without gravity, for a few steps: what does a contact do?  Kratos DEM.

    venv/bin/python3 -B probe.py cylinder|sphere DIR [DIR ...]

with contacts.py and cases.py beside it.  Each DIR holds a parameters.json and receives a motion.csv, one
row for every step from 0 on.

Units, floor and top wall as in stack.py; the top wall starts to move at step 0.  Positions, forces and
torques (about the centre, counter-clockwise) of a row belong together.  The velocities of a row,
and hence the initial ones, are those half a step earlier, from which the forces were computed.
"""
import cases
from contacts import DEM, K, Scene

COLUMNS = 'step,x1,y1,vx1,vy1,spin1,fx1,fy1,torque1,x2,y2,vx2,vy2,spin2,fx2,fy2,torque2,wall_force'


def probe(body, p, out):
    scene = Scene(body, p, [(p['x1'], p['y1']), (p['x2'], p['y2'])], p['wall_height'])
    for number, node in enumerate(scene.cylinders, 1):
        node.SetSolutionStepValue(K.VELOCITY, K.Array3([p['vx%d' % number], p['vy%d' % number], 0]))
        node.SetSolutionStepValue(K.ANGULAR_VELOCITY, K.Array3([0, 0, p['spin%d' % number]]))
    scene.start_top_wall()
    out.write(COLUMNS + '\n')
    for step in range(p['steps'] + 1):
        scene.place_top_wall(p['wall_height'] - p['wall_speed'] * step * p['time_step'])
        # A step computes the forces at the present positions and then moves on.
        motions = [motion(node) for node in scene.cylinders]
        scene.observed_step()
        row = [v for before, node in zip(motions, scene.cylinders) for v in (*before, *force(node))]
        out.write('%d,' % step + ','.join(map(repr, [*row, scene.wall_force()])) + '\n')


def motion(node):
    velocity = node.GetSolutionStepValue(K.VELOCITY)
    return node.X, node.Y, velocity[0], velocity[1], node.GetSolutionStepValue(K.ANGULAR_VELOCITY)[2]


def force(node):
    force = node.GetSolutionStepValue(K.TOTAL_FORCES)
    return force[0], force[1], node.GetSolutionStepValue(DEM.PARTICLE_MOMENT)[2]


cases.run('motion.csv', probe)
