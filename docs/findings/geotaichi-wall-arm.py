"""GeoTaichi: where does a wall act on a sphere?  Needs GeoTaichi alone; the page of the same name tells what it prints.

Two spheres of radius 1 are held 0.1 deep in a floor for one step, in which one slides and the other spins.
"""
import contextlib
import io
import math
import tempfile

import taichi as ti

ti.init(arch=ti.cpu, default_fp=ti.f64, log_level=ti.ERROR)

from src.dem.mainDEM import DEM
from src.utils.TypeDefination import vec3f

OVERLAP, SPEED, FLOOR, OUT = 0.1, 1e-3, 2.0, tempfile.TemporaryDirectory()
MODELS = {
    'Linear Model': {'NormalStiffness': 1.0, 'TangentialStiffness': 0.4, 'Friction': 0.5,
                     'NormalViscousDamping': 0.0, 'TangentialViscousDamping': 0.0},
    'Hertz Mindlin Model': {'ShearModulus': 1.0, 'Possion': 0.3, 'Friction': 0.5, 'Restitution': 1.0},
}
UP = {'OuterNormal': vec3f([0, 0, 1])}
CORNERS = {'vertice1': vec3f([-50, -50, FLOOR]), 'vertice2': vec3f([50, -50, FLOOR]), 'vertice3': vec3f([5, 50, FLOOR])}
WALLS = {
    'plane': {'WallType': 'Plane', 'WallCenter': vec3f([5, 5, FLOOR]), **UP},
    'facet': {'WallType': 'Facet', 'WallShape': 'Polygon', 'WallVertice': CORNERS, **UP},
}


def push(model, wall):
    """Both spheres after the step."""
    dem = DEM(log=False)
    dem.set_configuration(domain=vec3f([20, 10, 10]), gravity=vec3f([0, 0, 0]), log=False)
    dem.set_solver({'Timestep': 1e-3, 'SimulationTime': 0.0, 'SaveInterval': 1.0, 'SavePath': OUT.name}, log=False)
    dem.memory_allocate({'max_material_number': 2, 'max_particle_number': 4, 'max_sphere_number': 4, f'max_{wall}_number': 1,
                         'compaction_ratio': 1.0, 'verlet_distance_multiplier': 0.5}, log=False)
    dem.add_attribute(0, {'Density': 0.75 / math.pi, 'ForceLocalDamping': 0.0, 'TorqueLocalDamping': 0.0})
    for x, velocity, spin in ((5, SPEED, 0), (15, 0, SPEED)):
        dem.create_body({'BodyType': 'Sphere', 'Template': {
            'GroupID': 0, 'MaterialID': 0, 'Radius': 1.0, 'BodyPoint': vec3f([x, 5, FLOOR + 1 - OVERLAP]),
            'InitialVelocity': vec3f([velocity, 0, 0]), 'InitialAngularVelocity': vec3f([0, spin, 0])}})
    dem.add_wall({'WallID': 0, 'MaterialID': 1, **WALLS[wall]})
    dem.choose_contact_model(model, model)
    dem.add_property(0, 1, MODELS[model])
    dem.run()
    return dem.scene.particle[0], dem.scene.particle[1]


for model in MODELS:
    for wall in WALLS:
        with contextlib.redirect_stdout(io.StringIO()):
            slid, spun = push(model, wall)
        force = slid.contact_force[0]
        radii = {'the force turns the sphere': -slid.contact_torque[1] / force, 'its surface moves': -spun.contact_force[0] / force}
        for what, radius in radii.items():
            print(f'{model}, {wall}: {what} at the radius: asked for {1 - OVERLAP / 2:.6f}, found {radius:.6f}')
