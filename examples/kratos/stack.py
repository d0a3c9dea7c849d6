"""Three cylinders in a stack, compressed by a flat wall: Kratos DEM.

    venv/bin/python3 -B stack.py cylinder|sphere DIR [DIR ...]

with contacts.py and cases.py beside it.  Each DIR holds a parameters.json and receives a series.csv.
Units: radius = mass = normal contact stiffness = 1, hence time in sqrt(m/k_n).

         1           Cylinder 1 rests on 2 (right) and 3 (left), which rest on the floor
       3   2         y = 0, all just touching and free of stress.
    -----------

(a) gravity rises smoothly from 0 to its value, (b) the stack rests, (c) a frictionless wall
that just touches cylinder 1 moves down at constant speed.  Only (c) is recorded.

Rows: step 0 is the end of (b).  Positions, angles and contact forces of a row belong to the same
step; only the damping part of a force uses the velocity half a step earlier.  Angles count from the
stress-free state before (a), counter-clockwise positive.
"""
import math

import cases
from contacts import DEM, Scene

COLUMNS = ('step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,'
           'floor_n2,floor_t2,floor_n3,floor_t3')


def compress_stack(body, p, out):
    scene = Scene(body, p, [(0, 1 + math.sqrt(3)), (1, 1), (-1, 1)], wall_height=6)
    prepare(scene, p)
    compress(scene, p, out)


def prepare(scene, p):
    """Raises gravity, with first and second derivatives zero at both ends, and rests."""
    ramp = p['ramp_steps']
    for step in range(ramp):
        x = step / ramp
        scene.set_gravity(p['gravity'] * x**3 * (10 - 15 * x + 6 * x**2))
        scene.step()
    scene.set_gravity(p['gravity'])
    for _ in range(p['rest_steps']):
        scene.step()


def compress(scene, p, out):
    """Lowers the wall from the top of cylinder 1 and writes the series."""
    top = scene.cylinders[0].Y + 1
    scene.start_top_wall()
    out.write(COLUMNS + '\n')
    rows = row_steps(p)
    for step in range(p['compression_steps'] + 1):
        scene.place_top_wall(top - p['wall_speed'] * step * p['time_step'])
        if step not in rows:
            scene.step()
            continue
        # A step computes the forces at the present positions and then moves on.
        positions = [v for node in scene.cylinders for v in position(node)]
        scene.observed_step()
        row = [step * p['time_step'], scene.wall_force(), *positions, *floor_forces(scene)]
        out.write('%d,' % step + ','.join(map(repr, row)) + '\n')


def row_steps(p):
    coarse = range(0, p['fine_from_step'], p['coarse_every'])
    fine = range(p['fine_from_step'], p['compression_steps'] + 1, p['fine_every'])
    return {*coarse, *fine}


def position(node):
    return node.X, node.Y, node.GetSolutionStepValue(DEM.PARTICLE_ROTATION_ANGLE)[2]


def floor_forces(scene):
    """Normal (+y) and tangential (+x) force of the floor on cylinders 2 and 3, which touch no other wall."""
    on_walls = [node.GetSolutionStepValue(DEM.RIGID_ELEMENT_FORCE) for node in scene.cylinders[1:]]
    return [-force[axis] for force in on_walls for axis in (1, 0)]


cases.run('series.csv', compress_stack)
