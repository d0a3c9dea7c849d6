"""Spheres in a plane, walls and their contacts: GeoTaichi DEM, "Linear Model".

Shared by stack.py and probe.py, so that the probe measures what the stack runs with.
Units: radius = mass = normal contact stiffness = 1, hence time in sqrt(m/k_n).
The plane is x-z of GeoTaichi, with z upwards; y of tristack is its z.
"""
import math

import numpy as np
import taichi as ti

# What geotaichi.init does: `import geotaichi` ends in an ImportError (0.2.6), a relative import beyond the top level.
ti.init(arch=ti.cpu, cpu_max_num_threads=1, default_fp=ti.f64, default_ip=ti.i32, offline_cache=False, log_level=ti.ERROR)

from src.dem.mainDEM import DEM
from src.utils.TypeDefination import vec3f

BODY, FLOOR, TOP_WALL = 0, 1, 2  # materials; the floor is wall 0 and the top wall is wall 1
FAR = 100.0  # how far a wall reaches
vector = ti.types.vector(3, float)


class Scene:
    """Spheres on the floor, under a top wall.

    Taichi compiles for each scene, so there is one for all cases of a process, and `begin` clears it.  A step is
    `compute_forces` (forces at the present positions, from the velocities half a step earlier) and `move`.
    """

    def __init__(self, bodies, engine='SymplecticEuler'):
        self.dem = dem = DEM(log=False)
        dem.set_configuration(domain=vec3f([20, 10, 20]), gravity=vec3f([0, 0, 0]), engine=engine, search='LinkedCell', log=False)
        dem.set_solver({'Timestep': 0.1, 'SimulationTime': 1.0, 'SaveInterval': 1.0}, log=False)
        memory = {
            'max_material_number': 3,
            'max_particle_number': 4,  # with 2, the sums of the lists of neighbours are left out: the second sphere has no walls
            'max_sphere_number': 4,
            'max_facet_number': 2,
            'compaction_ratio': 1.0,
            'verlet_distance_multiplier': 4.0,
        }
        dem.memory_allocate(memory, log=False)
        density = 0.75 / math.pi  # a mass of 1
        dem.add_attribute(BODY, {'Density': density, 'ForceLocalDamping': 0.0, 'TorqueLocalDamping': 0.0})
        # Here every sphere is near every other and both walls, so that the lists of neighbours, which are made once, hold
        # them all; `begin` gives them their places.
        for n in range(bodies):
            template = {'GroupID': 0, 'MaterialID': BODY, 'Radius': 1.0, 'BodyPoint': vec3f([5.0 + 3.0 * n, 5.0, 3.0])}
            dem.create_body({'BodyType': 'Sphere', 'Template': template})
        for wall, (material, height, normal) in enumerate(((FLOOR, 0.0, 1.0), (TOP_WALL, 6.0, -1.0))):
            corners = ((-FAR, -FAR), (FAR, -FAR), (0.0, FAR))
            vertices = {f'vertice{n}': vec3f([x, y, height]) for n, (x, y) in enumerate(corners, 1)}
            shape = {'WallType': 'Facet', 'WallShape': 'Polygon', 'WallVertice': vertices, 'OuterNormal': vec3f([0, 0, normal])}
            dem.add_wall({'WallID': wall, 'MaterialID': material, **shape})
        dem.choose_contact_model('Linear Model', 'Linear Model')
        dem.add_essentials({})
        self.scene, self.sims, self.engine = dem.scene, dem.sims, dem.enginer
        self.neighbours = dem.contactor.neighbor
        self.engine.pre_calculation(self.sims, self.scene, self.neighbours)
        self.pairs, self.walls = dem.contactor.physpp.cplist, dem.contactor.physpw.cplist
        self.bodies = bodies
        assert self.neighbours.particle_particle[bodies] == bodies * (bodies - 1) // 2
        assert self.neighbours.particle_wall[bodies] == 2 * bodies
        self.state = np.zeros((bodies, 9))
        self.on_walls = np.zeros((bodies, 2, 2))

    def begin(self, p, places, wall_height, wall_speed=0.0):
        """Places spheres (x, y, vx, vy, spin) and walls, with the contacts of the task p and no springs."""
        self.sims.set_timestep(p['time_step'])
        self.pairs.oldTangOverlap.fill(0)
        self.walls.oldTangOverlap.fill(0)
        for n, (x, y, vx, vy, spin) in enumerate(places):
            place_sphere(self.scene.particle, self.scene.sphere, n, x, y, vx, vy, spin)
        self.set_top_wall(wall_height, wall_speed)
        self.set_gravity(0.0)
        self.set_contact(p, BODY, p['cylinder_friction'], effective_mass=0.5)
        self.set_contact(p, FLOOR, p['floor_friction'], effective_mass=1.0)
        self.set_contact(p, TOP_WALL, 0.0, effective_mass=1.0)

    def set_contact(self, p, material, friction, effective_mass):
        """The contact of a sphere with this material.  Damping is meant as a share of the critical one."""
        def share(damping, stiffness):
            return damping / (2 * math.sqrt(effective_mass * stiffness))

        contact = {
            'NormalStiffness': p['normal_stiffness'],
            'TangentialStiffness': p['tangential_stiffness'],
            'Friction': friction,
            'NormalViscousDamping': share(p['damping_normal'], p['normal_stiffness']),
            'TangentialViscousDamping': share(p['damping_tangential'], p['tangential_stiffness']),
        }
        self.dem.add_property(BODY, material, contact, dType='particle-particle' if material == BODY else 'particle-wall')

    def set_gravity(self, gravity):
        self.sims.set_gravity(vec3f([0.0, 0.0, -gravity]))

    def set_top_wall(self, height, speed):
        place_wall(self.scene.wall, 1, height, -speed)

    def compute_forces(self):
        self.engine.reset_particle_message(self.scene)
        self.engine.system_resolve(self.sims, self.scene, self.neighbours)

    def move(self):
        self.engine.integration(self.sims, self.scene, self.neighbours)

    def read(self):
        """x, y, angle, vx, vy, spin, fx, fy, torque of each sphere; and the force (up, right) of floor and top wall on it.

        Angles, spins and torques are counter-clockwise, which is about -y of GeoTaichi.
        """
        read_scene(self.bodies, self.scene.particle, self.scene.sphere, self.neighbours.particle_wall, self.walls,
                   self.state, self.on_walls)
        return self.state.tolist(), self.on_walls.tolist()


@ti.kernel
def place_sphere(particle: ti.template(), sphere: ti.template(), n: int, x: float, y: float, vx: float, vy: float, spin: float):
    particle[n].x = vector(x, 0.0, y)
    particle[n].v = vector(vx, 0.0, vy)
    particle[n].w = vector(0.0, -spin, 0.0)
    sphere[n].a = vector(0.0, 0.0, 0.0)
    sphere[n].angmoment = particle[n].w / sphere[n].inv_I
    sphere[n].q = ti.types.vector(4, float)(0.0, 0.0, 0.0, 1.0)


@ti.kernel
def place_wall(wall: ti.template(), n: int, height: float, velocity: float):
    wall[n].vertice1.z = height
    wall[n].vertice2.z = height
    wall[n].vertice3.z = height
    wall[n].v = vector(0.0, 0.0, velocity)


@ti.kernel
def read_scene(bodies: int, particle: ti.template(), sphere: ti.template(), offsets: ti.template(), contacts: ti.template(),
               state: ti.types.ndarray(), on_walls: ti.types.ndarray()):
    for n in range(bodies):
        body = particle[n]
        state[n, 0], state[n, 1] = body.x.x, body.x.z
        state[n, 2] = -2.0 * ti.atan2(sphere[n].q.y, sphere[n].q.w)
        state[n, 3], state[n, 4], state[n, 5] = body.v.x, body.v.z, -body.w.y
        state[n, 6], state[n, 7], state[n, 8] = body.contact_force.x, body.contact_force.z, -body.contact_torque.y
        for contact in range(offsets[n], offsets[n + 1]):
            force, wall = contacts[contact].cnforce + contacts[contact].csforce, contacts[contact].endID2
            on_walls[n, wall, 0], on_walls[n, wall, 1] = force.z, force.x
