"""Cylinders or spheres, walls and their contacts: Kratos DEM, DEM_D_Linear_Custom_Constants.

Shared by stack.py and probe.py, so that the probe measures what the stack runs with.
Units: radius = mass = normal contact stiffness = 1, hence time in sqrt(m/k_n).
"""
import json
import math

import KratosMultiphysics as K
import KratosMultiphysics.DEMApplication as DEM
from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

K.Logger.GetDefaultOutput().SetSeverity(K.Logger.Severity.WARNING)

CYLINDER, FLOOR, TOP_WALL = 1, 2, 3  # materials
FAR = 100  # how far a wall reaches
# What the bodies are: element, density for a mass of 1, condition of a wall with its corners (x, z).
BODIES = {
    'cylinder': ('CylinderParticle2D', 1 / math.pi, 'RigidEdge2D2N', ((-FAR, 0), (FAR, 0))),
    'sphere': ('SphericParticle3D', 0.75 / math.pi, 'RigidFace3D3N', ((-FAR, -FAR), (0, FAR), (FAR, -FAR))),
}
SEARCH = {
    # Neighbours are searched for at the beginning and in observed steps: whatever comes closer than
    # this in between must have been a neighbour before.
    'SearchTolerance': 4.0,
    'search_tolerance_against_walls': 4.0,
    'NeighbourSearchFrequency': 1,
}


class Scene(DEMAnalysisStage):
    """Cylinders at the given centres in the x-y plane, on the floor y = 0, under a top wall.

    `step` is one step of the C++ strategy without the Python around it, which takes most of the time:
    forces at the present positions, from the present velocities (those half a step earlier), then
    velocities, then positions.
    """

    def __init__(self, body, parameters, centres, wall_height):
        self.element, self.density, self.condition, self.corners = BODIES[body]
        self.p, self.centres, self.wall_height = parameters, centres, wall_height
        settings = {
            'Dimension': 2 if body == 'cylinder' else 3,
            'MaxTimeStep': parameters['time_step'],
            'TranslationalIntegrationScheme': 'Symplectic_Euler',
            'RotationalIntegrationScheme': 'Direct_Integration',
            'GravityZ': 0.0,
            'solver_settings': {'strategy': 'sphere_strategy'},
            'do_print_results_option': False,
            'dem_inlet_option': False,
            **SEARCH,
        }
        super().__init__(K.Model(), K.Parameters(json.dumps(settings)))
        self.Initialize()
        self.set_damping()
        self.step = self._GetSolver().cplusplus_strategy.SolveSolutionStep
        self.info = self.spheres_model_part.ProcessInfo
        self.cylinders = [self.spheres_model_part.GetNode(n) for n in range(1, 1 + len(centres))]

    def ReadModelParts(self, *_):
        """Called by Initialize, which then gives the bodies their materials."""
        cylinders, walls = self.spheres_model_part, self.rigid_face_model_part
        none_yet = cylinders.CreateNewProperties(0)
        for number, (x, y) in enumerate(self.centres, 1):
            cylinders.CreateNewNode(number, x, y, 0).SetSolutionStepValue(K.RADIUS, 1)
            cylinders.CreateNewElement(self.element, number, [number], none_yet)
        walls.AddProperties(none_yet)
        self.add_wall(walls.CreateSubModelPart('floor'), 0, none_yet)
        self.top = self.add_wall(walls.CreateSubModelPart('top'), self.wall_height, none_yet)
        self.all_model_parts.ComputeMaxIds()

    def add_wall(self, part, height, properties):
        """An edge or a triangle; its nodes have other numbers than those of cylinders."""
        first = 1 + len(self.centres) + self.rigid_face_model_part.NumberOfNodes()
        nodes = [part.CreateNewNode(first + n, x, height, z) for n, (x, z) in enumerate(self.corners)]
        part.CreateNewCondition(self.condition, first, [node.Id for node in nodes], properties)
        return nodes

    def ReadMaterialsFile(self):
        """Called by Initialize. Stiffnesses are those of the contact itself."""
        p = self.p
        friction = {CYLINDER: p['cylinder_friction'], FLOOR: p['floor_friction'], TOP_WALL: 0.0}
        # Equal moduli put the contact point of a pair in the middle of the overlap.
        body = {'PARTICLE_DENSITY': self.density, 'YOUNG_MODULUS': 1.0, 'POISSON_RATIO': 0.0, 'PARTICLE_MATERIAL': 1}
        contact = {
            'DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME': 'DEM_D_Linear_Custom_Constants',
            'K_NORMAL': p['normal_stiffness'],
            'K_TANGENTIAL': p['tangential_stiffness'],
            'COEFFICIENT_OF_RESTITUTION': 1.0,  # see set_damping
            'FRICTION_DECAY': 500.0,  # from static to dynamic friction, which are the same
        }
        materials = [{'material_name': str(m), 'material_id': m, 'Variables': body} for m in friction]
        relations = [
            {
                'material_names_list': [str(CYLINDER), str(m)],
                'material_ids_list': [CYLINDER, m],
                'Variables': {**contact, 'STATIC_FRICTION': mu, 'DYNAMIC_FRICTION': mu},
            }
            for m, mu in friction.items()
        ]
        bodies = (('SpheresPart', CYLINDER), ('RigidFacePart.floor', FLOOR), ('RigidFacePart.top', TOP_WALL))
        assignment = [[part, str(m)] for part, m in bodies]
        text = json.dumps({'materials': materials, 'material_relations': relations, 'material_assignation_table': assignment})
        self.DEM_material_parameters = K.Parameters(text)

    def set_damping(self):
        """Normal damping 2 gamma sqrt(m k_n), tangential 2 gamma sqrt(m k_t), m effective: 1/2 for a pair.

        Initialize has computed gamma from the restitution, to four digits.
        """
        for relation in self.spheres_model_part.GetProperties()[CYLINDER].GetSubProperties():
            mass = 0.5 if relation.Id == CYLINDER else 1.0
            critical = 2 * math.sqrt(mass * self.p['normal_stiffness'])
            relation[DEM.DAMPING_GAMMA] = self.p['damping_normal'] / critical

    def observed_step(self):
        """A step with a search: walls count the forces of the cylinders that the last search has found."""
        self.info[K.TIME_STEPS] = 1
        self.step()
        self.info[K.TIME_STEPS] = 0

    def set_gravity(self, gravity):
        self.info[K.GRAVITY] = K.Array3([0, -gravity, 0])

    def start_top_wall(self):
        for node in self.top:
            node.SetSolutionStepValue(K.VELOCITY_Y, -self.p['wall_speed'])

    def place_top_wall(self, height):
        for node in self.top:
            node.Y = height

    def wall_force(self):
        """Force of the top wall in the last step, positive in compression."""
        return sum(node.GetSolutionStepValue(DEM.CONTACT_FORCES_Y) for node in self.top)
