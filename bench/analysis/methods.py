"""The methods: each makes of a case a function that measures it, and says how many rays, points or segments it takes.

A method is called with a case and gives (measure, budgets): measure(budget, seed) gives {figure: (value, CPU seconds)}
of the figures volume and area that it tells. A program gives a third: its CPU seconds until it measures.
"""
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from itertools import combinations
from statistics import median

import numpy as np

from cases import CENTRE, Refused, regions_of, scene_of

CHUNK = 1_000_000


def seconds(who=resource.RUSAGE_SELF):
    """CPU seconds of this process and its threads, or of its children: user and system."""
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def timed(function, *arguments):
    start = seconds()
    return function(*arguments), seconds() - start


def program(name):
    """A program beside this Python, or on the path."""
    found = shutil.which(name, path=os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"])
    if found is None:
        raise Refused(f"the program {name} is not installed")
    return found


def run(command, **options):
    """What a program says, and its CPU seconds."""
    before = seconds(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode:
        raise Refused(f"{os.path.basename(command[0])}: " + " ".join((done.stdout + done.stderr).split())[-300:])
    return done.stdout, seconds(resource.RUSAGE_CHILDREN) - before


# ---- csgrt, and other estimators with its kernels

def csgrt(case):
    """Its module, which has no start for each measure; the start is that of the command."""
    scene = scene_of(case)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "scene.json")
        scene.save(file)
        start = median(run([program("csgrt"), "measure", file, "--rays", "1", "--json", "-"])[1] for _ in range(9))
    scene.measure(rays=1)

    def measure(rays, seed):
        made, spent = timed(lambda: scene.measure(rays=rays, seed=seed).parts[0])
        return {"volume": (made.volume.nominal, spent), "area": (made.area.nominal, spent)}
    return measure, [10 ** i for i in range(3, 8)], start


def in_chunks(count):
    return [min(CHUNK, count - done) for done in range(0, count, CHUNK)]


def random_lines(random, count, centre, radius):
    """Isotropic lines through a ball: each line that meets it is as likely. (count, 6)."""
    d = random.normal(size=(count, 3))
    d /= np.linalg.norm(d, axis=1)[:, None]
    u = np.cross(d, np.eye(3)[np.argmin(abs(d), axis=1)])
    u /= np.linalg.norm(u, axis=1)[:, None]
    r, angle = radius * np.sqrt(random.random(count)), 2 * np.pi * random.random(count)
    offset = r[:, None] * (np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * np.cross(d, u))
    return np.hstack([centre + offset, d])


def by_lines(partitions, bounds, count, random):
    """Volume by chords, area by the number of boundaries (Crofton); partitions: of Scene. Only its calls are timed."""
    centre, radius = bounds.mean(0), np.linalg.norm(bounds[1] - bounds[0]) / 2
    length = ends = spent = 0
    for size in in_chunks(count):
        found, took = timed(partitions, random_lines(random, size, centre, radius), -np.inf)
        length += (found["t_out"] - found["t_in"]).sum()
        ends += 2 * len(found["t_in"])
        spent += took
    a_line = np.pi * radius ** 2 / count
    return {"volume": (length * a_line, spent), "area": (2 * ends * a_line, spent)}


def by_points(region_at, bounds, count, random):
    inside = spent = 0
    for size in in_chunks(count):
        found, took = timed(region_at, bounds[0] + (bounds[1] - bounds[0]) * random.random((size, 3)))
        inside += (found >= 0).sum()
        spent += took
    return {"volume": (np.prod(bounds[1] - bounds[0]) * inside / count, spent)}


def grid_rays(bounds, spacing, axis):
    """gqa's rays of a view: from one spacing beside the box's low corner on."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    along = [bounds[0, i] + spacing * np.arange(1, int((bounds[1, i] - bounds[0, i]) / spacing) + 1) for i in (u, v)]
    rays = np.zeros((len(along[0]) * len(along[1]), 6))
    rays[:, u], rays[:, v] = (plane.ravel() for plane in np.meshgrid(*along))
    rays[:, axis], rays[:, 3 + axis] = bounds[0, axis], 1
    return rays


def gqa_spacing(span, steps):
    """0.005 mm, halved or doubled until the longest side has `steps` spacings at least, and the shortest two."""
    return 0.005 * 2.0 ** np.floor(np.log2(min(max(span) / steps, min(span) / 2) / 0.005))


def by_grid(partitions, bounds, steps):
    """The mean of three views along the axes; of each the mean length of its rays times its area, as gqa has it."""
    span = bounds[1] - bounds[0]
    volume = spent = 0
    for axis in range(3):
        rays = grid_rays(bounds, gqa_spacing(span, steps), axis)
        found, took = timed(partitions, rays, -np.inf)
        volume += (found["t_out"] - found["t_in"]).sum() / len(rays) * np.delete(span, axis).prod() / 3
        spent += took
    return {"volume": (volume, spent)}


def lines(case):
    scene = scene_of(case)
    return (lambda count, seed: by_lines(scene.partitions, scene.bounds, count, np.random.default_rng(seed)),
            [10 ** i for i in range(3, 8)])


def points(case):
    scene = scene_of(case)
    return (lambda count, seed: by_points(scene.region_at, scene.bounds, count, np.random.default_rng(seed)),
            [10 ** i for i in range(3, 8)])


def grid(case):
    scene = scene_of(case)
    return lambda steps, seed: by_grid(scene.partitions, scene.bounds, steps), [16, 64, 256, 1024]


# ---- OpenMC: points in cells

def half_spaces(corners):
    """(normal, distance) of the faces of the convex hull of some corners."""
    size, middle, found = np.ptp(corners, axis=0).max(), corners.mean(0), {}
    for a, b, c in combinations(corners, 3):
        normal = np.cross(b - a, c - a)
        if np.linalg.norm(normal) < 1e-9 * size ** 2:
            continue
        normal /= np.linalg.norm(normal)
        normal = normal if normal @ (a - middle) > 0 else -normal
        if ((corners - a) @ normal).max() < 1e-5 * size:
            found.setdefault(tuple((normal * 1e4).round()), (normal, normal @ a))
    if len(found) < 4:
        raise Refused("not translated: an arb that is not convex")
    return list(found.values())


def quadric(local, base, axes):
    """OpenMC's ten numbers of local's form in (p - base) by axes, which are the rows."""
    back = np.eye(4)
    back[:3, :3] = np.linalg.inv(np.transpose(axes))
    back[:3, 3] = -back[:3, :3] @ base
    q = back.T @ local @ back
    return [q[0, 0], q[1, 1], q[2, 2], 2 * q[0, 1], 2 * q[1, 2], 2 * q[0, 2], 2 * q[0, 3], 2 * q[1, 3], 2 * q[2, 3],
            q[3, 3]]


def openmc_geometry(regions):
    surfaces, cells = [], []

    def surface(kind, numbers):
        surfaces.append(f'<surface id="{len(surfaces) + 1}" type="{kind}" coeffs="' +
                        " ".join(repr(float(x)) for x in numbers) + '"/>')
        return f"-{len(surfaces)}"

    def text(tree):
        kind, *of = tree
        if kind == "union":
            return "(" + " | ".join(map(text, of)) + ")"
        if kind == "intersection":
            return "(" + " ".join(map(text, of)) + ")"
        if kind == "difference":
            return "(" + text(of[0]) + "".join(f" ~{text(other)}" for other in of[1:]) + ")"
        if kind == "arb":
            return "(" + " ".join(surface("plane", [*n, d]) for n, d in half_spaces(of[0])) + ")"
        if kind == "tor":
            centre, axis, radius, tube = of
            if abs(axis).max() < 1 - 1e-9:
                raise Refused("it holds no torus that is not along an axis")
            return "(" + surface("xyz"[np.argmax(abs(axis))] + "-torus", [*centre, radius, tube, tube]) + ")"
        if kind == "ell":
            centre, axes = of
            size = np.linalg.norm(axes[0])
            if abs(axes @ axes.T - size ** 2 * np.eye(3)).max() < 1e-12 * size ** 2:
                return "(" + surface("sphere", [*centre, size]) + ")"
            return "(" + surface("quadric", quadric(np.diag([1, 1, 1, -1.0]), centre, axes)) + ")"
        base, height, a, b, c, d = of
        top = np.linalg.norm(c) / np.linalg.norm(a)
        if max(abs(c - top * a).max(), abs(d - top * b).max()) > 1e-6 * np.linalg.norm(a):
            raise Refused("it holds no tgc whose ends are not alike")
        local = np.diag([1, 1, -(top - 1) ** 2, -1])
        local[2, 3] = local[3, 2] = 1 - top
        normal = np.cross(a, b) / np.linalg.norm(np.cross(a, b))
        normal = normal if normal @ height > 0 else -normal
        return "(" + " ".join([surface("quadric", quadric(local, base, (a, b, height))),
                               surface("plane", [*-normal, -normal @ base]),
                               surface("plane", [*normal, normal @ (base + height)])]) + ")"
    for i, tree in enumerate(regions):
        cells.append(f'<cell id="{i + 1}" region="{text(tree)}" material="void" universe="0"/>')
    surfaces[0] = surfaces[0].replace("/>", ' boundary="vacuum"/>')  # it wants one, and points do not cross it
    return "<geometry>" + "\n".join(surfaces + cells) + "</geometry>"


SETTINGS = """<settings><run_mode>volume</run_mode><particles>1</particles><batches>1</batches><seed>{seed}</seed>
<volume_calc><domain_type>cell</domain_type><domain_ids>{cells}</domain_ids><samples>{samples}</samples>
<lower_left>{low}</lower_left><upper_right>{high}</upper_right></volume_calc></settings>"""


def openmc(case):
    command = [program("openmc")]
    regions, bounds, folder = regions_of(case), scene_of(case).bounds, tempfile.TemporaryDirectory()

    def write(name, text):
        with open(os.path.join(folder.name, name), "w", encoding="utf-8") as file:
            file.write(text)
    write("geometry.xml", openmc_geometry(regions))
    write("materials.xml", "<materials><cross_sections>cross_sections.xml</cross_sections></materials>")
    write("cross_sections.xml", '<cross_sections><library materials="H1" path="none.h5" type="neutron"/>'
          "</cross_sections>")

    def volume_of(samples, seed):
        write("settings.xml", SETTINGS.format(
            seed=seed, samples=samples, cells=" ".join(str(i + 1) for i in range(len(regions))),
            low=" ".join(map(repr, bounds[0].tolist())), high=" ".join(map(repr, bounds[1].tolist()))))
        said, spent = run(command, cwd=folder.name, env={**os.environ, "OMP_NUM_THREADS": "1"})
        told = [line.split(":")[1].split() for line in said.splitlines() if line.startswith("   Cell ")]
        return sum(float(words[0]) for words in told), spent
    start = median(volume_of(1, 1)[1] for _ in range(9))

    def measure(samples, seed):
        volume, spent = volume_of(samples, seed)
        return {"volume": (volume, spent - start)}
    measure.folder = folder  # which lives as long
    return measure, [10 ** i for i in range(4, 8)], start


# ---- Geant4: points in and near solids

class Geant4Solids:
    """Makes Geant4's solids of trees, about a centre: what is there and is not turned stands as it is."""
    def __init__(self, centre):
        try:
            import geant4_pybind
        except ImportError as missing:
            raise Refused(f"geant4-pybind is not installed: {missing}") from None
        self.g4, self.centre, self.kept = geant4_pybind, centre, []

    def keep(self, value):
        self.kept.append(value)
        return value

    def moved(self, solid, x, y, z, at):
        """A solid whose axes become these unit vectors."""
        g4, turn, offset = self.g4, np.array([x, y, z]), at - self.centre
        if abs(turn - np.eye(3)).max() < 1e-12 and abs(offset).max() < 1e-12:
            return solid
        rotation = g4.G4RotationMatrix()
        rotation.rotateAxes(*(g4.G4ThreeVector(*axis) for axis in turn))
        place = self.keep(g4.G4Transform3D(rotation, g4.G4ThreeVector(*offset)))
        return self.keep(g4.G4DisplacedSolid("moved", solid, place))

    def mesh(self, vertices, faces):
        g4, made = self.g4, self.keep(self.g4.G4TessellatedSolid("mesh"))
        points = [g4.G4ThreeVector(*(np.array(vertex) - self.centre)) for vertex in vertices]
        for face in faces:
            made.AddFacet(self.keep(g4.G4TriangularFacet(*(points[i] for i in face), g4.ABSOLUTE)))
        made.SetSolidClosed(True)
        return made

    def made(self, tree):
        g4, keep, (kind, *of) = self.g4, self.keep, tree
        if kind in ("difference", "intersection", "union"):
            joined, *rest = map(self.made, of)
            join = {"difference": g4.G4SubtractionSolid, "intersection": g4.G4IntersectionSolid,
                    "union": g4.G4UnionSolid}[kind]
            for other in rest:
                joined = keep(join("joined", joined, other))
            return joined
        if kind == "mesh":
            return self.mesh(*of)
        if kind == "ell" and np.ptp(np.linalg.norm(of[1], axis=1)) < 1e-12:
            return self.moved(keep(g4.G4Orb("ball", np.linalg.norm(of[1][0]))), *np.eye(3), of[0])
        if kind == "arb" and len(of[0]) == 8:
            edges = of[0][[1, 3, 4]] - of[0][0]
            sides = np.linalg.norm(edges, axis=1)
            if abs(of[0][0] + edges.sum(0) - of[0][6]).max() > 1e-9 * max(sides) or \
                    abs(edges @ edges.T - np.diag(sides ** 2)).max() > 1e-9 * max(sides) ** 2:
                raise Refused("not translated: an arb8 that is no box")
            edges[2] *= np.sign(np.linalg.det(edges))  # a mirrored box is a box
            return self.moved(keep(g4.G4Box("box", *sides / 2)), *(edges / sides[:, None]), of[0].mean(0))
        if kind == "tor" and abs(of[1][2]) == 1:
            return self.moved(keep(g4.G4Torus("torus", 0, of[3], of[2], 0, 2 * np.pi)), *np.eye(3), of[0])
        if kind == "tgc":
            base, height, x, y, c, d = of
            long, radius, top = np.linalg.norm(height), np.linalg.norm(x), np.linalg.norm(c)
            if abs(np.linalg.norm(y) - radius) < 1e-12 and abs(height @ x) < 1e-12 * long * radius and \
                    abs(radius * c - top * x).max() + abs(radius * d - top * y).max() < 1e-12 * radius:
                rod = g4.G4Cons("rod", 0, radius, 0, top, long / 2, 0, 2 * np.pi) if top != radius else \
                    g4.G4Tubs("rod", 0, radius, long / 2, 0, 2 * np.pi)
                return self.moved(keep(rod), x / radius, np.cross(height, x) / long / radius, height / long,
                                  base + height / 2)
        raise Refused("not translated: " + {
            "ell": "an ellipsoid", "arb": "an arb that is no box", "tor": "a turned torus",
            "tgc": "a tgc that is no round cylinder or cone"}[kind])


def geant4(case):
    solids = Geant4Solids(CENTRE)
    regions = regions_of(case)
    if len(regions) > 1:
        raise Refused("several regions: its estimates are of one solid")
    solid = solids.made(regions[0])

    def measure(count, seed):
        # Points are the same in every call: the points after `seed` times as many are those of another seed.
        after, spent = timed(solid.EstimateCubicVolume, count * (seed + 1), 1e-3)
        before = solid.EstimateCubicVolume(count * seed, 1e-3) if seed else 0
        volume = (seed + 1) * after - seed * before
        # Layers for the area depend on the number, so numbers differ by one in a hundred.
        area, took = timed(solid.EstimateSurfaceArea, count + seed * count // 100, -1.0)
        return {"volume": (volume, spent / (seed + 1)), "area": (area, took)}
    measure.solids = solids  # which live as long
    return measure, [10 ** i for i in range(3, 8)]


# ---- Manifold: meshes

def manifold(case):
    try:
        from manifold3d import CrossSection, Manifold, Mesh64, OpType
    except ImportError as missing:
        raise Refused(f"manifold3d is not installed: {missing}") from None

    def loft(base, height, a, b, c, d, count):
        if not c.any() and not d.any():
            raise Refused("not translated: a tgc with a tip")
        angle = 2 * np.pi * np.arange(count) / count
        turn = np.column_stack([np.cos(angle), np.sin(angle)])
        rings = np.vstack([base + turn @ [a, b], base + height + turn @ [c, d], [base, base + height]])
        i = np.arange(count)
        j = (i + 1) % count
        faces = np.vstack([np.column_stack(f) for f in (
            (i, j, count + i), (j, count + j, count + i), (j, i, 0 * i + 2 * count),
            (count + i, count + j, 0 * i + 2 * count + 1))])
        if np.cross(a, b) @ height < 0:
            faces = faces[:, ::-1]
        return Manifold(Mesh64(rings, faces.astype(np.uint64)))

    def made(tree, count):
        kind, *of = tree
        if kind in ("difference", "intersection", "union"):
            return Manifold.batch_boolean([made(operand, count) for operand in of], {
                "difference": OpType.Subtract, "intersection": OpType.Intersect, "union": OpType.Add}[kind])
        if kind == "arb":
            return Manifold.hull_points(of[0])
        if kind == "ell":
            return Manifold.sphere(1, count).transform(np.column_stack([*of[1], of[0]]))
        if kind == "tor":
            centre, axis, radius, tube = of
            x = np.cross(axis, np.eye(3)[np.argmin(abs(axis))])
            x /= np.linalg.norm(x)
            ring = Manifold.revolve(CrossSection.circle(tube, count).translate((radius, 0)), count)
            return ring.transform(np.column_stack([x, np.cross(axis, x), axis, centre]))
        return loft(*of, count)
    regions = regions_of(case)

    def measure(count, seed):
        def figures():
            whole = Manifold.batch_boolean([made(tree, count) for tree in regions], OpType.Add)
            if whole.status().name != "NoError":
                raise Refused(f"Manifold: {whole.status().name}")
            return whole.volume(), whole.surface_area()
        (volume, area), spent = timed(figures)
        return {"volume": (volume, spent), **({"area": (area, spent)} if len(regions) == 1 else {})}
    return measure, [16 * 2 ** i for i in range(7)]


METHODS = {"csgrt": csgrt, "random lines": lines, "random points": points, "regular grid": grid, "OpenMC": openmc,
           "Geant4": geant4, "Manifold": manifold}
# Methods that give the same figures for each seed.
FIXED = ("regular grid", "Manifold")
