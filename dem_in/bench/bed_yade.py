"""The bed of bed.in under YADE: yade -n -x -j1 dem_in/bench/bed_yade.py, with a JSON of the variables in
the environment variable BED. YADE's law is the same spring, dashpot and Coulomb bound
(Law2_ScGeom_ViscElPhys_Basic), its damper given per pair as c = gamma m_eff."""
import json
import math
import os

from yade import utils

bed = json.loads(os.environ["BED"])
lines = open(bed["bed"]).read().split("Atoms")[1].split("\n")
spheres = [list(map(float, line.split())) for line in lines if len(line.split()) == 7]
mass = spheres[0][3] * math.pi / 6 * spheres[0][2] ** 3
# Two equal bodies in series are the pair: twice the stiffness and damping each. A wall's is the sphere's,
# with its mass for m_eff: four times the damping a side would need; the floor is a small part of the bed.
half = mass / 2
material = O.materials.append(ViscElMat(
    density=spheres[0][3], kn=2 * bed["kn"], ks=2 * bed["kt"], cn=2 * bed["gamman"] * half,
    cs=2 * bed["gammat"] * half, frictionAngle=math.atan(bed["mu"])))
for _, _, diameter, _, x, y, z in spheres:
    O.bodies.append(utils.sphere((x, y, z), diameter / 2, material=material))
for place, axis in ((0, 2), (0, 0), (4, 0), (0, 1), (4, 1)):
    O.bodies.append(utils.wall(place, axis=axis, material=material))
tilt = math.radians(bed["tilt"])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=bed["skin"] / 2),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
                    [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0, gravity=(9.81 * math.sin(tilt), 0, -9.81 * math.cos(tilt))),
]
O.dt = bed["timestep"]
O.run(bed["steps"], wait=True)
n = len(spheres)
ke = sum(mass / 2 * O.bodies[i].state.vel.squaredNorm() for i in range(n))
print("RESULT", json.dumps(dict(ke=ke, x=sum(O.bodies[i].state.pos[0] for i in range(n)) / n,
                                z=sum(O.bodies[i].state.pos[2] for i in range(n)) / n)))
