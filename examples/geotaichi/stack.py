"""Three spheres in a stack, compressed by a flat wall: GeoTaichi DEM.

    venv/bin/python3 -B stack.py SymplecticEuler DIR [DIR ...]

with contacts.py and cases.py beside it.  Each DIR holds a task.json and receives a result.csv.

         1           Sphere 1 rests on 2 (right) and 3 (left), which rest on the floor
       3   2         y = 0, all just touching and free of stress.
    -----------

(a) gravity rises smoothly from 0 to its value, (b) the stack rests, (c) a frictionless wall
that just touches sphere 1 moves down at constant speed.  Only (c) is recorded.
"""
import cases

COLUMNS = 'step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,floor_n2,floor_t2,floor_n3,floor_t3'


def stack(scene, p, write):
    places = [(p['initial_x%d' % n], p['initial_y%d' % n], 0.0, 0.0, 0.0) for n in (1, 2, 3)]
    scene.begin(p, places, wall_height=6.0)
    for step in range(p['ramp_steps'] + p['rest_steps']):
        if step <= p['ramp_steps']:
            x = step / p['ramp_steps']
            scene.set_gravity(p['gravity'] * x**3 * (10 - 15 * x + 6 * x**2))
        scene.compute_forces()
        scene.move()
    scene.set_gravity(p['gravity'])
    bodies, _ = scene.read()
    scene.set_top_wall(bodies[0][1] + 1.0, p['wall_speed'])
    write(COLUMNS)
    fine, last = p['fine_from_step'], p['compression_steps']
    rows = {*range(0, fine, p['coarse_every']), *range(fine, last + 1, p['fine_every'])}
    for step in range(last + 1):
        scene.compute_forces()
        if step in rows:
            bodies, on_walls = scene.read()
            (_, (wall, _)), *floors = on_walls
            write(step, step * p['time_step'], -wall, *(value for body in bodies for value in body[:3]),
                  *(value for floor, _ in floors for value in floor))
        scene.move()


cases.run(3, stack)
