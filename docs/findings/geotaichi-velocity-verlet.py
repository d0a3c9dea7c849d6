"""GeoTaichi: does an oscillator without damping keep its amplitude?  Needs GeoTaichi alone; the page of the same name tells
what it prints.

A sphere (mass 1, normal stiffness 1) oscillates on a floor under gravity, without ever leaving it.
"""
import contextlib
import io
import math
import tempfile

import taichi as ti

ti.init(arch=ti.cpu, default_fp=ti.f64, log_level=ti.ERROR)

from src.dem.mainDEM import DEM
from src.utils.TypeDefination import vec3f

OUT = tempfile.TemporaryDirectory()
GRAVITY, AMPLITUDE, PERIOD = 0.05, 0.01, 2 * math.pi
CONTACT = {'NormalStiffness': 1.0, 'TangentialStiffness': 0.4, 'Friction': 0.5,
           'NormalViscousDamping': 0.0, 'TangentialViscousDamping': 0.0}


def growth(engine, steps):
    """Amplitude after a period of so many steps, over that at the beginning."""
    dem = DEM(log=False)
    dem.set_configuration(domain=vec3f([10, 10, 10]), gravity=vec3f([0, 0, -GRAVITY]), engine=engine, log=False)
    dem.set_solver({'Timestep': PERIOD / steps, 'SimulationTime': (1 - 0.5 / steps) * PERIOD, 'SaveInterval': 10.0,
                    'SavePath': OUT.name}, log=False)
    dem.memory_allocate({'max_material_number': 2, 'max_particle_number': 4, 'max_sphere_number': 4, 'max_plane_number': 1,
                         'compaction_ratio': 1.0, 'verlet_distance_multiplier': 1.0}, log=False)
    dem.add_attribute(0, {'Density': 0.75 / math.pi, 'ForceLocalDamping': 0.0, 'TorqueLocalDamping': 0.0})
    rest = 2 - GRAVITY
    dem.create_body({'BodyType': 'Sphere', 'Template': {
        'GroupID': 0, 'MaterialID': 0, 'Radius': 1.0, 'BodyPoint': vec3f([5, 5, rest + AMPLITUDE])}})
    dem.add_wall({'WallID': 0, 'MaterialID': 1, 'WallType': 'Plane', 'WallCenter': vec3f([5, 5, 1]),
                  'OuterNormal': vec3f([0, 0, 1])})
    dem.choose_contact_model('Linear Model', 'Linear Model')
    dem.add_property(0, 1, CONTACT)
    dem.run()
    return (dem.scene.particle[0].x[2] - rest) / AMPLITUDE


for engine in ('SymplecticEuler', 'VelocityVerlet'):
    for steps in (400, 200, 100):
        with contextlib.redirect_stdout(io.StringIO()):
            found = growth(engine, steps)
        print(f'{engine}, {steps} steps a period: amplitude after one: asked for 1, found {found:.4f}')
