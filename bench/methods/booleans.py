#!/usr/bin/env python3
"""The Booleans of meshes, by Manifold (PyPI manifold3d, Apache 2.0). mesh.cpp runs it.

    booleans.py FOLDER MEGABYTES

reads FOLDER/solids.json, solids.vertices (three doubles each) and solids.triangles (three 32-bit numbers each, of the
solid's own vertices), and writes the same of regions. A region is a list in postfix order: a number is a solid, [OP, N]
joins the last N operands. MEGABYTES is a limit of memory. Manifold computes in double, and so it is given and asked
(Mesh64). It joins a union's or an intersection's operands in the order that it finds best.
"""

import importlib.metadata
import json
import resource
import sys
import time


def main():
    folder, megabytes = sys.argv[1], int(sys.argv[2])
    try:
        import numpy
        from manifold3d import Error, Manifold, Mesh64, OpType
    except ImportError as error:
        sys.exit(f"Python has no manifold3d (pip install manifold3d): {error}")
    resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
    with open(folder + "/solids.json") as file:
        model = json.load(file)
    vertices = numpy.fromfile(folder + "/solids.vertices", numpy.float64).reshape(-1, 3)
    triangles = numpy.fromfile(folder + "/solids.triangles", numpy.uint32).reshape(-1, 3).astype(numpy.uint64)

    start, start_cpu = time.perf_counter(), time.process_time()
    solids, first_vertex, first_triangle = [], 0, 0
    for solid in model["solids"]:
        last_vertex, last_triangle = first_vertex + solid["vertices"], first_triangle + solid["triangles"]
        mesh = Mesh64(vertices[first_vertex:last_vertex].copy(), triangles[first_triangle:last_triangle].copy())
        made = Manifold(mesh)
        if made.status() != Error.NoError:
            sys.exit(f"Manifold does not take the mesh of {solid['name']}: {made.status()}")
        solids.append(made)
        first_vertex, first_triangle = last_vertex, last_triangle

    def joined(operator, operands):
        if operator == "union":
            return Manifold.batch_boolean(operands, OpType.Add)
        if operator == "intersection":
            return Manifold.batch_boolean(operands, OpType.Intersect)
        if operator == "difference":
            return Manifold.batch_boolean(operands, OpType.Subtract)
        result = operands[0]
        for other in operands[1:]:
            result = (result - other) + (other - result)  # xor
        return result

    found, all_vertices, all_triangles = [], [], []
    for region in model["regions"]:
        operands = []
        for node in region:
            if isinstance(node, int):
                operands.append(solids[node])
            else:
                operator, count = node
                operands[len(operands) - count :] = [joined(operator, operands[len(operands) - count :])]
        result = operands.pop() if operands else Manifold()
        mesh = result.to_mesh64()
        if result.status() != Error.NoError:
            sys.exit(f"Manifold fails: {result.status()}")
        all_vertices.append(numpy.asarray(mesh.vert_properties, numpy.float64)[:, :3])
        all_triangles.append(numpy.asarray(mesh.tri_verts).astype(numpy.uint32))
        found.append({"vertices": len(all_vertices[-1]), "triangles": len(all_triangles[-1])})
    seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - start_cpu

    numpy.concatenate(all_vertices).tofile(folder + "/regions.vertices")
    numpy.concatenate(all_triangles).tofile(folder + "/regions.triangles")
    told = {
        "manifold3d": importlib.metadata.version("manifold3d"),
        "numpy": numpy.__version__,
        "seconds": seconds,
        "cpu_seconds": cpu_seconds,
        "peak_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "regions": found,
    }
    with open(folder + "/regions.json", "w") as file:
        json.dump(told, file)


if __name__ == "__main__":
    try:
        main()
    except MemoryError:
        sys.exit("not enough memory")
