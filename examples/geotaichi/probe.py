"""Spheres 1 and 2 alone, without gravity, for a few steps: what does a contact do?  GeoTaichi DEM.

    venv/bin/python3 -B probe.py SymplecticEuler DIR [DIR ...]

with contacts.py and cases.py beside it.  Each DIR holds a task.json and receives a result.csv, one row for
every step from 0 on.  Floor and top wall are as in stack.py; the top wall starts to move at step 0.
"""
import cases

COLUMNS = 'step,x1,y1,vx1,vy1,spin1,fx1,fy1,torque1,x2,y2,vx2,vy2,spin2,fx2,fy2,torque2,wall_force'


def probe(scene, p, write):
    places = [[p[name + body] for name in ('x', 'y', 'vx', 'vy', 'spin')] for body in '12']
    scene.begin(p, places, p['wall_height'], p['wall_speed'])
    write(COLUMNS)
    for step in range(p['steps'] + 1):
        scene.compute_forces()
        bodies, on_walls = scene.read()
        motions = (value for x, y, _, *rest in bodies for value in (x, y, *rest))
        write(step, *motions, -sum(top for _, (top, _) in on_walls))
        scene.move()


cases.run(2, probe)
